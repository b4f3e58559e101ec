/** The grid as an image with a pixel per cell; only changed cells are redrawn. */

import { changesSince } from "../cells";
import type { Region } from "../protocol";
import type { MapState } from "../store";
import { css, mix, type Palette } from "./palette";
import type { Sheet } from "./sheet";

/** Cells of at least this size show their grid lines. */
const GRID_LINES_FROM_PX = 8;
/** Cells of less than this size are smoothed. */
const SMOOTH_BELOW_PX = 2;

export class Ground {
  private readonly canvas = document.createElement("canvas");
  private shown: { values: Int8Array; version: number; colors: Palette } | null = null;

  draw(sheet: Sheet, map: MapState): void {
    this.update(map, sheet.colors);
    const ctx = sheet.inCells(map);
    ctx.fillStyle = css(sheet.colors.free);
    ctx.fillRect(0, 0, map.n_cols, map.n_rows);
    drawCells(sheet, map, this.canvas);
    if (map.resolution_m * sheet.view.pxPerM >= GRID_LINES_FROM_PX) drawGridLines(sheet, map);
    sheet.pen(sheet.colors.rule, 1);
    ctx.strokeRect(0, 0, map.n_cols, map.n_rows);
  }

  private update(map: MapState, colors: Palette): void {
    const { shown, canvas } = this;
    const isSame = shown !== null && shown.values === map.values && shown.colors === colors;
    if (isSame && shown.version === map.version) return;
    const changes = isSame ? changesSince(map, shown.version) : null;
    if (canvas.width !== map.n_cols || canvas.height !== map.n_rows) {
      [canvas.width, canvas.height] = [map.n_cols, map.n_rows];
    }
    const whole = { col: 0, row: 0, n_cols: map.n_cols, n_rows: map.n_rows };
    const table = tableOf(colors);
    for (const region of changes ?? [whole]) paint(canvas, map, region, table);
    this.shown = { values: map.values, version: map.version, colors };
  }
}

/** Draws an image of a pixel per cell, its first row lowest. */
export function drawCells(sheet: Sheet, map: MapState, image: HTMLCanvasElement): void {
  const { ctx } = sheet;
  const cellPx = map.resolution_m * sheet.view.pxPerM * sheet.dpr;
  ctx.imageSmoothingEnabled = cellPx < SMOOTH_BELOW_PX;
  ctx.imageSmoothingQuality = cellPx < 1 ? "high" : "low";
  ctx.drawImage(image, 0, 0, map.n_cols, map.n_rows);
}

function paint(canvas: HTMLCanvasElement, map: MapState, region: Region, table: Uint32Array): void {
  const ctx = canvas.getContext("2d");
  if (ctx === null) return;
  const image = new ImageData(region.n_cols, region.n_rows);
  const pixels = new Uint32Array(image.data.buffer);
  for (let row = 0; row < region.n_rows; row += 1) {
    const from = (region.row + row) * map.n_cols + region.col;
    const to = row * region.n_cols;
    for (let col = 0; col < region.n_cols; col += 1) {
      pixels[to + col] = table[(map.values[from + col] ?? -1) + 1] ?? 0;
    }
  }
  ctx.putImageData(image, region.col, region.row);
}

/** Pixels by value, from -1 unknown to 100 occupied; free ground is left out. */
function tableOf(colors: Palette): Uint32Array {
  const table = new Uint32Array(128);
  for (let cost = 1; cost < 100; cost += 1) {
    table[cost + 1] = pixel(mix(colors.free, colors.graded, cost / 99));
  }
  table[0] = pixel(colors.unknown);
  table.fill(pixel(colors.obstacle), 101);
  return table;
}

/** A pixel as images hold it: bytes red, green, blue, alpha, on a little-endian machine. */
export function pixel([red, green, blue]: readonly [number, number, number], alpha = 255): number {
  return ((alpha << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}

function drawGridLines(sheet: Sheet, map: MapState): void {
  const { ctx } = sheet;
  ctx.beginPath();
  for (let col = 1; col < map.n_cols; col += 1) {
    ctx.moveTo(col, 0);
    ctx.lineTo(col, map.n_rows);
  }
  for (let row = 1; row < map.n_rows; row += 1) {
    ctx.moveTo(0, row);
    ctx.lineTo(map.n_cols, row);
  }
  sheet.pen(sheet.colors.muted, 0.5);
  sheet.faint(0.22, () => ctx.stroke());
}
