/** The visible part of the world: its center and a scale. Maps side by side share one. */

import { bounds, type Grid } from "../cells";
import type { Store } from "../store";

export type Point = [number, number];

/** Cells are at most so large. */
const MAX_CELL_PX = 120;
/** The map shrinks to at least so much of the view. */
const LEAST_SHARE = 0.35;
/** Room around the map when it is fitted. */
const MARGIN_PX = 18;
const LEAST_MARGIN_PX = 6;
/** The tools stand in the upper left corner, so wide and high. */
const TOOLS_PX: Point = [276, 80];

export class Camera {
  x = 0;
  y = 0;
  pxPerM = 10;
  /** Whether the whole map is shown, unchanged since it was fitted. */
  isFitted = true;
  private minPxPerM = 1e-3;
  private maxPxPerM = 1e4;
  private readonly listeners: (() => void)[] = [];

  onChange(call: () => void): void {
    this.listeners.push(call);
  }

  /** Fits the whole map into a view, beside or below the tools if there is room. */
  fit(grid: Grid, widthPx: number, heightPx: number): void {
    const { low, high } = bounds(grid);
    const [widthM, heightM] = [high[0] - low[0], high[1] - low[1]];
    const room = (px: number) => Math.max(px - 2 * MARGIN_PX, 0.5 * px);
    const scale = Math.min(room(widthPx) / widthM, room(heightPx) / heightM);
    const [left, top] = [(widthPx - scale * widthM) / 2, (heightPx - scale * heightM) / 2];
    this.minPxPerM = LEAST_SHARE * scale;
    this.maxPxPerM = Math.max(MAX_CELL_PX / grid.resolution_m, 2 * scale);
    const [right, down] = aside(left, top);
    this.x = (low[0] + high[0]) / 2 - right / scale;
    this.y = (low[1] + high[1]) / 2 + down / scale;
    this.pxPerM = scale;
    this.isFitted = true;
    this.tell();
  }

  /** Moves the world under the view by pixels. */
  pan(dxPx: number, dyPx: number): void {
    this.isFitted = false;
    this.x -= dxPx / this.pxPerM;
    this.y += dyPx / this.pxPerM;
    this.tell();
  }

  /** Zooms by a factor about a fixed point. */
  zoom(factor: number, [x, y]: Point): void {
    this.isFitted = false;
    const before = this.pxPerM;
    this.pxPerM = Math.min(Math.max(before * factor, this.minPxPerM), this.maxPxPerM);
    const share = before / this.pxPerM;
    this.x = x + (this.x - x) * share;
    this.y = y + (this.y - y) * share;
    this.tell();
  }

  private tell(): void {
    for (const call of this.listeners) call();
  }
}

/** The shift that moves a map with such margins out from under the tools, right or down. */
function aside(left: number, top: number): Point {
  const [right, down] = [TOOLS_PX[0] - left, TOOLS_PX[1] - top];
  if (right <= 0 || down <= 0) return [0, 0];
  if (down <= top - LEAST_MARGIN_PX) return [0, down];
  return right <= left - LEAST_MARGIN_PX ? [right, 0] : [0, Math.max(0, top - LEAST_MARGIN_PX)];
}

/** A camera in a window of a size, CSS pixels. */
export class View {
  constructor(
    readonly camera: Camera,
    public widthPx: number,
    public heightPx: number,
  ) {}

  get pxPerM(): number {
    return this.camera.pxPerM;
  }

  toPx(x: number, y: number): Point {
    const { camera } = this;
    return [
      (x - camera.x) * camera.pxPerM + this.widthPx / 2,
      (camera.y - y) * camera.pxPerM + this.heightPx / 2,
    ];
  }

  /** Whether a point is in the window. */
  shows(x: number, y: number): boolean {
    const [px, py] = this.toPx(x, y);
    return px >= 0 && py >= 0 && px <= this.widthPx && py <= this.heightPx;
  }

  toWorld([px, py]: Point): Point {
    const { camera } = this;
    return [
      (px - this.widthPx / 2) / camera.pxPerM + camera.x,
      camera.y - (py - this.heightPx / 2) / camera.pxPerM,
    ];
  }
}

const cameras = new WeakMap<Store, Camera>();

/** The camera of all maps that show the same state. */
export function cameraOf(store: Store): Camera {
  const camera = cameras.get(store) ?? new Camera();
  cameras.set(store, camera);
  return camera;
}
