/** Measurements of the page itself, for tests: `window.formicar.stats`. */

import type { Store } from "./store";

const MAX_SAMPLES = 1000;
/** A longer pause between two frames is not slowness: nothing had to be drawn. */
const PAUSE_MS = 250;

export class Stats {
  /** From each move of a dragged end (or brush) to its drawn path, milliseconds. */
  readonly dragToDrawnMs: number[] = [];
  /** Time spent on drawing a map, milliseconds. */
  readonly drawMs: number[] = [];
  /** Between two drawn frames while something moves, milliseconds. */
  readonly betweenFramesMs: number[] = [];
  nMessages = 0;
  nFramesDrawn = 0;
  private lastFrameMs = -Infinity;

  /** Plans under way because something was dragged, and when. */
  private readonly dragged = new Map<number, number>();

  asked(plan: number, atMs: number): void {
    this.dragged.set(plan, atMs);
  }

  /** A plan stands on the screen: its first path, or that there is none, which is not counted. */
  planDrawn(plan: number, hasPath: boolean): void {
    const askedMs = this.dragged.get(plan);
    if (askedMs === undefined) return;
    for (const older of [...this.dragged.keys()]) if (older <= plan) this.dragged.delete(older);
    if (hasPath) keep(this.dragToDrawnMs, performance.now() - askedMs);
  }

  /** A map was drawn, which took so long. */
  frameDrawn(tookMs: number, isMoving: boolean): void {
    this.nFramesDrawn += 1;
    keep(this.drawMs, tookMs);
    const now = performance.now();
    const between = now - this.lastFrameMs;
    // Two maps side by side are drawn in one frame.
    if (between < 1) return;
    if (isMoving && between < PAUSE_MS) keep(this.betweenFramesMs, between);
    this.lastFrameMs = now;
  }

  get medianDragToDrawnMs(): number | null {
    return median(this.dragToDrawnMs);
  }

  /** Over the last frames while something moved. */
  get framesPerSecond(): number | null {
    const last = this.betweenFramesMs.slice(-60);
    const sum = last.reduce((a, b) => a + b, 0);
    return sum > 0 ? (1000 * last.length) / sum : null;
  }

  reset(): void {
    for (const list of [this.dragToDrawnMs, this.drawMs, this.betweenFramesMs]) list.length = 0;
    this.nFramesDrawn = this.nMessages = 0;
    this.lastFrameMs = -Infinity;
  }
}

/** The page's figures; there is one page. */
export const stats = new Stats();

/** Lays state and figures open as `window.formicar`. */
export function expose(store: Store): void {
  Object.assign(window, { formicar: { store, stats } });
}

function keep(list: number[], value: number): void {
  list.push(value);
  if (list.length > MAX_SAMPLES) list.splice(0, list.length - MAX_SAMPLES);
}

function median(list: readonly number[]): number | null {
  if (list.length === 0) return null;
  const sorted = [...list].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  const upper = sorted[middle] ?? 0;
  return sorted.length % 2 === 1 ? upper : (upper + (sorted[middle - 1] ?? 0)) / 2;
}
