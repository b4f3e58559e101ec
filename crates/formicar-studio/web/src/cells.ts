/** Cells of a map: where they lie, how they change, and which have changed. */

import type { Pose, Region } from "./protocol";
import type { MapState } from "./store";

/** Rows that are sent as one rectangle: strokes askew would else span much that is unchanged. */
const BAND_ROWS = 16;
/** Changes kept at most; a view further behind redraws the whole map. */
const MAX_CHANGES = 256;

export type Grid = Pick<MapState, "n_cols" | "n_rows" | "resolution_m" | "origin">;

/** World coordinates of a place in cells, the middle of the first being (0.5, 0.5). */
export function toWorld(grid: Grid, col: number, row: number): [number, number] {
  const [x, y, yaw] = grid.origin;
  const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
  const [u, v] = [col * grid.resolution_m, row * grid.resolution_m];
  return [x + cos * u - sin * v, y + sin * u + cos * v];
}

/** The place in cells, not rounded. */
export function toCells(grid: Grid, x: number, y: number): [number, number] {
  const [originX, originY, yaw] = grid.origin;
  const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
  const [u, v] = [x - originX, y - originY];
  return [(cos * u + sin * v) / grid.resolution_m, (cos * v - sin * u) / grid.resolution_m];
}

/** Corners of the map in world coordinates, counter-clockwise. */
export function corners(grid: Grid): [number, number][] {
  const { n_cols: w, n_rows: h } = grid;
  return [[0, 0] as const, [w, 0] as const, [w, h] as const, [0, h] as const].map(([col, row]) =>
    toWorld(grid, col, row),
  );
}

/** Least and most world coordinates of a map. */
export function bounds(grid: Grid): { low: [number, number]; high: [number, number] } {
  const all = corners(grid);
  const [xs, ys] = [all.map(([x]) => x), all.map(([, y]) => y)];
  return {
    low: [Math.min(...xs), Math.min(...ys)],
    high: [Math.max(...xs), Math.max(...ys)],
  };
}

/** Rectangles that hold all of these cells. */
export function regionsOf(cells: Iterable<number>, nCols: number): Region[] {
  const bands = new Map<number, Region>();
  for (const cell of cells) {
    const [col, row] = [cell % nCols, Math.floor(cell / nCols)];
    const key = Math.floor(row / BAND_ROWS);
    const band = bands.get(key);
    bands.set(key, band === undefined ? { col, row, n_cols: 1, n_rows: 1 } : grown(band, col, row));
  }
  return [...bands.values()];
}

/** The values in a rectangle, row by row, lowest row first. */
export function valuesIn(map: MapState, region: Region): number[] {
  const values: number[] = [];
  for (let row = region.row; row < region.row + region.n_rows; row += 1) {
    const from = row * map.n_cols + region.col;
    values.push(...map.values.subarray(from, from + region.n_cols));
  }
  return values;
}

const changes = new WeakMap<Int8Array, { version: number; region: Region }[]>();

/** Notes that rectangles have changed; the map's version grows. */
export function noteChange(map: MapState, regions: readonly Region[]): void {
  map.version += 1;
  map.isEdited = true;
  const list = changes.get(map.values) ?? [];
  for (const region of regions) list.push({ version: map.version, region });
  if (list.length > MAX_CHANGES) list.splice(0, list.length - MAX_CHANGES);
  changes.set(map.values, list);
}

/** The changes since a version; null if they are no longer known. */
export function changesSince(map: MapState, version: number): Region[] | null {
  const list = changes.get(map.values) ?? [];
  const oldest = list[0]?.version ?? Infinity;
  if (version < map.version && version + 1 < oldest) return null;
  // Of the oldest version a part may be forgotten already.
  if (list.length === MAX_CHANGES && version < oldest) return null;
  return list.filter((change) => change.version > version).map((change) => change.region);
}

/** A pose rounded to a tenth of a millimeter and of a milliradian: links and commands stay short. */
export function rounded([x, y, heading]: Pose): Pose {
  const round = (value: number) => Math.round(value * 1e4) / 1e4;
  return [round(x), round(y), round(Math.atan2(Math.sin(heading), Math.cos(heading)))];
}

function grown(region: Region, col: number, row: number): Region {
  const [left, low] = [Math.min(region.col, col), Math.min(region.row, row)];
  const right = Math.max(region.col + region.n_cols, col + 1);
  const top = Math.max(region.row + region.n_rows, row + 1);
  return { col: left, row: low, n_cols: right - left, n_rows: top - low };
}
