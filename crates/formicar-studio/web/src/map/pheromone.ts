/** Pheromone as a heat map: an image of a pixel per cell. */

import type { MapState } from "../store";
import { drawCells, pixel } from "./ground";
import { heat, type Palette } from "./palette";
import type { Sheet } from "./sheet";

/** The faintest shades are let through to the ground. */
const ALPHA_LOW = 90;
const ALPHA_HIGH = 235;

export class Pheromone {
  private readonly canvas = document.createElement("canvas");
  private shown: { bytes: Uint8Array; colors: Palette } | null = null;

  draw(sheet: Sheet, map: MapState, bytes: Uint8Array): void {
    if (bytes.length !== map.n_cols * map.n_rows) return;
    this.update(map, bytes, sheet.colors);
    sheet.inCells(map);
    drawCells(sheet, map, this.canvas);
  }

  private update(map: MapState, bytes: Uint8Array, colors: Palette): void {
    if (this.shown?.bytes === bytes && this.shown.colors === colors) return;
    const { canvas } = this;
    if (canvas.width !== map.n_cols || canvas.height !== map.n_rows) {
      [canvas.width, canvas.height] = [map.n_cols, map.n_rows];
    }
    const image = new ImageData(map.n_cols, map.n_rows);
    const pixels = new Uint32Array(image.data.buffer);
    const table = tableOf(colors);
    for (let i = 0; i < bytes.length; i += 1) pixels[i] = table[bytes[i] ?? 0] ?? 0;
    canvas.getContext("2d")?.putImageData(image, 0, 0);
    this.shown = { bytes, colors };
  }
}

function tableOf(colors: Palette): Uint32Array {
  const table = new Uint32Array(256);
  for (let level = 1; level < 256; level += 1) {
    const t = (level - 1) / 254;
    const alpha = Math.round(ALPHA_LOW + (ALPHA_HIGH - ALPHA_LOW) * t);
    table[level] = pixel(heat(t, colors.isDark), alpha);
  }
  return table;
}
