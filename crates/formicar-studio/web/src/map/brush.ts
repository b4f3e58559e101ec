/** Cells under a round brush that is drawn from place to place. */

import { toCells, type Grid } from "../cells";
import type { Point } from "./camera";
import type { Sheet } from "./sheet";

/** Cells whose middle lies within the brush; at least the one under its middle. */
export function cellsUnder(grid: Grid, from: Point, to: Point, diameterM: number): number[] {
  const [a, b] = [toCells(grid, ...from), toCells(grid, ...to)];
  const radius = diameterM / 2 / grid.resolution_m;
  const { n_cols, n_rows } = grid;
  const within = (value: number, n: number) => Math.min(Math.max(Math.floor(value), 0), n - 1);
  const [left, right] = [Math.min(a[0], b[0]) - radius, Math.max(a[0], b[0]) + radius];
  const [low, high] = [Math.min(a[1], b[1]) - radius, Math.max(a[1], b[1]) + radius];
  const cells: number[] = [];
  const isOff = right < 0 || high < 0 || left >= n_cols || low >= n_rows;
  if (isOff) return cells;
  for (let row = within(low, n_rows); row <= within(high, n_rows); row += 1) {
    for (let col = within(left, n_cols); col <= within(right, n_cols); col += 1) {
      if (distance([col + 0.5, row + 0.5], a, b) <= radius) cells.push(row * n_cols + col);
    }
  }
  const [col, row] = b.map(Math.floor) as [number, number];
  const isOn = col >= 0 && row >= 0 && col < n_cols && row < n_rows;
  if (isOn && cells.length === 0) cells.push(row * n_cols + col);
  return cells;
}

/** The outline of the brush. */
export function drawBrush(sheet: Sheet, [x, y]: Point, diameterM: number): void {
  const ctx = sheet.inWorld();
  ctx.beginPath();
  ctx.arc(x, y, Math.max(diameterM / 2, sheet.px(2)), 0, 2 * Math.PI);
  sheet.pen(sheet.colors.page, 3.4);
  ctx.stroke();
  sheet.pen(sheet.colors.ink, 1.4);
  ctx.stroke();
}

/** From a place to a stretch. */
function distance([x, y]: Point, a: Point, b: Point): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const squared = dx * dx + dy * dy;
  const t = squared > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / squared : 0;
  const share = Math.min(Math.max(t, 0), 1);
  return Math.hypot(x - a[0] - share * dx, y - a[1] - share * dy);
}
