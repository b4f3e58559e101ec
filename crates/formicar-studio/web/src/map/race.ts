/** Ants that drive, and hybrid A* that grows beside them. */

import type { DriveFrame } from "../protocol";
import type { Frame } from "../store";
import { Ants } from "./ant";
import type { Palette } from "./palette";
import { addPolyline, type Sheet } from "./sheet";

/** Ants of a generation, on their way by a share of it; the one before is faint. */
export function drawDrivers(
  sheet: Sheet,
  frame: DriveFrame,
  before: DriveFrame | null,
  share: number,
): void {
  if (before !== null) sheet.faint(0.35 * (1 - 0.6 * share), () => drawWays(sheet, before, 1));
  drawWays(sheet, frame, share);
}

function drawWays(sheet: Sheet, frame: DriveFrame, share: number): void {
  const { colors } = sheet;
  const ctx = sheet.inWorld();
  const kinds = [
    { ways: frame.died, color: colors.lost, alpha: 0.6, width: 1 },
    { ways: frame.arrived, color: colors.arrived, alpha: 0.8, width: 1.6 },
  ];
  for (const { ways, color, alpha, width } of kinds) {
    const ants = new Ants(sheet);
    ctx.beginPath();
    for (const way of ways) {
      const done = upTo(way, share);
      addPolyline(ctx, done);
      const n = done.length;
      if (n < 4 || share >= 1) continue;
      const [x, y] = [done[n - 2]!, done[n - 1]!];
      ants.add(x, y, x - done[n - 4]!, y - done[n - 3]!, 1.6);
    }
    sheet.pen(color, width);
    sheet.faint(alpha, () => ctx.stroke());
    ants.draw(color);
  }
}

/** The first share of a polyline, by points, which lie evenly. */
function upTo(way: readonly number[], share: number): number[] {
  const nPoints = way.length >> 1;
  const reach = Math.min(Math.max(share, 0), 1) * (nPoints - 1);
  const whole = Math.floor(reach);
  const done = way.slice(0, 2 * whole + 2);
  const t = reach - whole;
  if (t > 1e-3 && whole + 1 < nPoints) {
    const [x, y] = [way[2 * whole]!, way[2 * whole + 1]!];
    done.push(x + t * (way[2 * whole + 2]! - x), y + t * (way[2 * whole + 3]! - y));
  }
  return done;
}

const lines = new WeakMap<number[], Path2D>();

/** Motions that the search has expanded, on a canvas of their own: only what is new is drawn. */
export class Expanded {
  private key = "";
  private colors: Palette | null = null;
  private frames: readonly Frame[] = [];
  private nDrawn = 0;

  constructor(private readonly sheet: Sheet) {}

  /** Shows the motions of the first `nBegun` frames. */
  draw(frames: readonly Frame[], nBegun: number): void {
    const { sheet } = this;
    const { camera } = sheet.view;
    const { width, height } = sheet.canvas;
    const key = [camera.x, camera.y, camera.pxPerM, width, height].join();
    const isSame = key === this.key && sheet.colors === this.colors && frames === this.frames;
    if (!isSame || nBegun < this.nDrawn) {
      sheet.clear();
      this.nDrawn = 0;
    }
    [this.key, this.colors, this.frames] = [key, sheet.colors, frames];
    if (nBegun <= this.nDrawn) return;
    const ctx = sheet.inWorld();
    sheet.pen(sheet.colors.waypoints, 0.9);
    ctx.globalAlpha = 0.55;
    for (const frame of frames.slice(this.nDrawn, nBegun)) {
      if (frame.type === "expanded") ctx.stroke(lineOf(frame.motions));
    }
    ctx.globalAlpha = 1;
    this.nDrawn = nBegun;
  }

  /** Shows nothing. */
  clear(): void {
    if (this.nDrawn === 0) return;
    this.sheet.clear();
    this.nDrawn = 0;
  }
}

/** The newest motions stand out. */
export function drawNewest(sheet: Sheet, frame: Frame | undefined): void {
  if (frame?.type !== "expanded") return;
  const ctx = sheet.inWorld();
  sheet.pen(sheet.colors.reverse, 1.6);
  ctx.stroke(lineOf(frame.motions));
}

function lineOf(motions: number[]): Path2D {
  const known = lines.get(motions);
  if (known) return known;
  const path = new Path2D();
  for (let i = 0; i + 3 < motions.length; i += 4) {
    path.moveTo(motions[i]!, motions[i + 1]!);
    path.lineTo(motions[i + 2]!, motions[i + 3]!);
  }
  lines.set(motions, path);
  return path;
}
