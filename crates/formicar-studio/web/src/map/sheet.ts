/** A canvas with its view and colors: what every layer draws on. */

import type { Grid } from "../cells";
import type { View } from "./camera";
import type { Palette } from "./palette";

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export class Sheet {
  readonly ctx: CanvasRenderingContext2D;
  dpr = 1;
  /** Rectangles of text since it was cleared, pixels, which further text avoids. */
  readonly words: Box[] = [];
  /** Pixels of a unit of the coordinates that are drawn in: meters, cells or pixels. */
  private unitPx = 1;

  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly view: View,
    public colors: Palette,
  ) {
    const ctx = canvas.getContext("2d");
    if (ctx === null) throw new Error("the browser has no canvas to draw the map on");
    this.ctx = ctx;
  }

  /** Takes on the size of the view. */
  resize(dpr: number): void {
    this.dpr = dpr;
    const [width, height] = [this.view.widthPx, this.view.heightPx].map((px) =>
      Math.round(px * dpr),
    );
    if (width !== undefined && this.canvas.width !== width) this.canvas.width = width;
    if (height !== undefined && this.canvas.height !== height) this.canvas.height = height;
  }

  clear(): void {
    this.words.length = 0;
    this.ctx.setTransform(1, 0, 0, 1, 0, 0);
    this.ctx.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }

  /** From here on coordinates are pixels. */
  inPixels(): CanvasRenderingContext2D {
    this.ctx.setTransform(this.dpr, 0, 0, this.dpr, 0, 0);
    this.unitPx = 1;
    return this.ctx;
  }

  /** From here on coordinates are meters, y up. */
  inWorld(): CanvasRenderingContext2D {
    const { ctx, view, dpr } = this;
    const scale = view.pxPerM * dpr;
    const [x, y] = view.toPx(0, 0);
    ctx.setTransform(scale, 0, 0, -scale, x * dpr, y * dpr);
    this.unitPx = view.pxPerM;
    return ctx;
  }

  /** From here on coordinates are columns and rows, the first cell from 0 to 1. */
  inCells(grid: Grid): CanvasRenderingContext2D {
    const ctx = this.inWorld();
    const [x, y, yaw] = grid.origin;
    ctx.translate(x, y);
    ctx.rotate(yaw);
    ctx.scale(grid.resolution_m, grid.resolution_m);
    this.unitPx = this.view.pxPerM * grid.resolution_m;
    return ctx;
  }

  /** Pixels in the units that are drawn in. */
  px(pixels: number): number {
    return pixels / this.unitPx;
  }

  /** Sets a pen of a width and a dash in pixels. */
  pen(color: string, widthPx: number, dashPx: readonly number[] = []): void {
    const { ctx } = this;
    ctx.strokeStyle = color;
    ctx.lineWidth = this.px(widthPx);
    ctx.setLineDash(dashPx.map((length) => this.px(length)));
    ctx.lineJoin = "round";
    ctx.lineCap = dashPx.length > 0 ? "butt" : "round";
  }

  /** Draws with a share of opacity. */
  faint(alpha: number, draw: () => void): void {
    const before = this.ctx.globalAlpha;
    this.ctx.globalAlpha = before * alpha;
    draw();
    this.ctx.globalAlpha = before;
  }
}

/** A polyline of x, y, x, y ... added to a path. */
export function addPolyline(
  path: Path2D | CanvasRenderingContext2D,
  points: ArrayLike<number>,
): void {
  for (let i = 0; i + 1 < points.length; i += 2) {
    const [x, y] = [points[i] as number, points[i + 1] as number];
    if (i === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  }
}
