/** Ants that walk over cells: where they went, and how they stream from start to goal. */

import type { GenerationFrame, IterationFrame } from "../protocol";
import type { MapState } from "../store";
import { Ants } from "./ant";
import { addPolyline, type Sheet } from "./sheet";

/** Passages are drawn in as many shades, by how many ants went. */
const N_SHADES = 4;
/** Ants walk in so many lanes, each its own way where ways part. */
const N_LANES = 14;
/** In a lane they are so many cells apart and walk so many a second; on large maps more. */
const FOLLOW_CELLS = 14;
const CELLS_PER_S = 14;
const FOLLOW_SHARE = 1 / 12;
const SHARE_PER_S = 1 / 7;

interface Drawn {
  arrived: Path2D[];
  lost: Path2D[];
  best: Path2D;
  /** Ways of the lanes: x, y, x, y ... */
  lanes: number[][];
}

const drawn = new WeakMap<IterationFrame, Drawn>();

/** Draws where the ants of an iteration went, and the best way. */
export function drawPassages(sheet: Sheet, map: MapState, frame: IterationFrame): void {
  const { colors } = sheet;
  const ctx = sheet.inCells(map);
  const { lost, arrived, best } = prepared(frame);
  const layers = [
    { shades: lost, color: colors.lost, most: 0.55 },
    { shades: arrived, color: colors.arrived, most: 0.85 },
  ];
  for (const { shades, color, most } of layers) {
    shades.forEach((shade, i) => {
      sheet.pen(color, 0.7 + 0.45 * i);
      sheet.faint((most * (i + 1.5)) / (N_SHADES + 0.5), () => ctx.stroke(shade));
    });
  }
  drawBest(sheet, best);
}

/** Draws ants on their paths after a time in seconds. */
export function drawWalkers(
  sheet: Sheet,
  map: MapState,
  frame: IterationFrame,
  walkedS: number,
): void {
  sheet.inCells(map);
  const { lanes } = prepared(frame);
  const nAcross = Math.max(map.n_cols, map.n_rows);
  const follow = Math.max(FOLLOW_CELLS, FOLLOW_SHARE * nAcross);
  const speed = Math.max(CELLS_PER_S, SHARE_PER_S * nAcross);
  const ants = new Ants(sheet);
  lanes.forEach((lane, i) => {
    const nSteps = (lane.length >> 1) - 1;
    for (
      let at = (walkedS * speed + (i / lanes.length) * follow) % follow;
      at < nSteps;
      at += follow
    ) {
      const step = Math.floor(at);
      const [x, y, toX, toY] = lane.slice(2 * step, 2 * step + 4) as [
        number,
        number,
        number,
        number,
      ];
      const t = at - step;
      ants.add(x + t * (toX - x), y + t * (toY - y), toX - x, toY - y);
    }
  });
  ants.draw(sheet.colors.arrived);
}

/** Draws a generation of a genetic algorithm. */
export function drawGeneration(sheet: Sheet, map: MapState, frame: GenerationFrame): void {
  const { colors } = sheet;
  const ctx = sheet.inCells(map);
  const layers = [
    { lines: frame.colliding, color: colors.lost, alpha: 0.4 },
    { lines: frame.free, color: colors.arrived, alpha: 0.5 },
  ];
  for (const { lines, color, alpha } of layers) {
    ctx.beginPath();
    for (const line of lines) addPolyline(ctx, centered(line));
    sheet.pen(color, 1);
    sheet.faint(alpha, () => ctx.stroke());
  }
  const best = new Path2D();
  addPolyline(best, centered(frame.best));
  drawBest(sheet, best);
}

function drawBest(sheet: Sheet, best: Path2D): void {
  sheet.pen(sheet.colors.page, 4.6);
  sheet.ctx.stroke(best);
  sheet.pen(sheet.colors.forward, 2);
  sheet.ctx.stroke(best);
}

function prepared(frame: IterationFrame): Drawn {
  const known = drawn.get(frame);
  if (known !== undefined) return known;
  const best = new Path2D();
  addPolyline(best, centered(frame.best));
  const [arrived, lost] = [shades(frame.arrived), shades(frame.lost)];
  const made = { arrived, lost, best, lanes: lanesOf(frame) };
  drawn.set(frame, made);
  return made;
}

/** Passages by the logarithm of how many ants went. */
function shades(passages: readonly number[]): Path2D[] {
  const paths = Array.from({ length: N_SHADES }, () => new Path2D());
  let most = 1;
  for (let i = 4; i < passages.length; i += 5) most = Math.max(most, passages[i] ?? 0);
  for (let i = 0; i + 4 < passages.length; i += 5) {
    const share = Math.log(1 + (passages[i + 4] ?? 0)) / Math.log(1 + most);
    const path = paths[Math.min(Math.floor(share * N_SHADES), N_SHADES - 1)];
    path?.moveTo((passages[i] ?? 0) + 0.5, (passages[i + 1] ?? 0) + 0.5);
    path?.lineTo((passages[i + 2] ?? 0) + 0.5, (passages[i + 3] ?? 0) + 0.5);
  }
  return paths;
}

/** Passages do not say which way ants went: away from the start, as they do on the whole. A lane
 * takes at every cell the passage that its own number picks, many ants' ways more often, so that
 * it stays much the same from frame to frame. */
function lanesOf(frame: IterationFrame): number[][] {
  const passages = passagesByCell([...frame.arrived, ...frame.lost]);
  const [startCol, startRow] = frame.best;
  if (startCol === undefined || startRow === undefined) return [];
  const start = keyOf(startCol, startRow);
  const depths = depthsFrom(start, passages);
  return Array.from({ length: N_LANES }, (_, lane) => {
    const way = [startCol + 0.5, startRow + 0.5];
    for (let at: number | null = start; at !== null;) {
      const depth: number = depths.get(at) ?? 0;
      const onwards: Passage[] = (passages.get(at) ?? []).filter(
        ({ to }) => (depths.get(to) ?? 0) > depth,
      );
      const next = pick(onwards, noise(lane, at));
      if (next !== null) way.push(next.col + 0.5, next.row + 0.5);
      at = next?.to ?? null;
    }
    return way;
  });
}

interface Passage {
  to: number;
  col: number;
  row: number;
  nAnts: number;
}

function passagesByCell(flat: readonly number[]): Map<number, Passage[]> {
  const passages = new Map<number, Passage[]>();
  const add = (from: number, col: number, row: number, nAnts: number) => {
    const passage = { to: keyOf(col, row), col, row, nAnts };
    const list = passages.get(from);
    if (list) list.push(passage);
    else passages.set(from, [passage]);
  };
  for (let i = 0; i + 4 < flat.length; i += 5) {
    const [col, row, toCol, toRow, n] = flat.slice(i, i + 5) as [
      number,
      number,
      number,
      number,
      number,
    ];
    add(keyOf(col, row), toCol, toRow, n);
    add(keyOf(toCol, toRow), col, row, n);
  }
  return passages;
}

/** Passages from the start to every cell, at least. */
function depthsFrom(start: number, passages: Map<number, Passage[]>): Map<number, number> {
  const depths = new Map([[start, 0]]);
  const queue = [start];
  for (let head = 0; head < queue.length; head += 1) {
    const from = queue[head]!;
    for (const { to } of passages.get(from) ?? []) {
      if (depths.has(to)) continue;
      depths.set(to, depths.get(from)! + 1);
      queue.push(to);
    }
  }
  return depths;
}

function pick(passages: readonly Passage[], chance: number): Passage | null {
  let left = chance * passages.reduce((sum, { nAnts }) => sum + nAnts, 0);
  for (const passage of passages) {
    left -= passage.nAnts;
    if (left <= 0) return passage;
  }
  return passages.at(-1) ?? null;
}

function keyOf(col: number, row: number): number {
  return row * 65536 + col;
}

/** A number from 0 to 1 that looks like chance. */
function noise(lane: number, cell: number): number {
  const mixed = Math.imul((lane + 1) * 0x9e3779b1 + cell, 0x85ebca6b);
  return ((mixed ^ (mixed >>> 15)) >>> 0) / 2 ** 32;
}

/** Cells to the middles of cells. */
function centered(cells: readonly number[]): number[] {
  return cells.map((coordinate) => coordinate + 0.5);
}
