/** The papers' steps on the map: grown obstacles, closed U-shapes, the way over cells, its nodes. */

import type { Stages } from "../protocol";
import type { StepName } from "../steps";
import type { MapState } from "../store";
import { addPolyline, type Sheet } from "./sheet";

const ORDER: readonly StepName[] = [
  "map",
  "expanded",
  "closed",
  "cells",
  "nodes",
  "arcs",
  "judged",
];

/** Whether a step is the shown one or comes before it. */
export function isTold(name: StepName, shown: StepName): boolean {
  return ORDER.indexOf(name) <= ORDER.indexOf(shown);
}

/** Cells: they lie under everything else. */
export function drawStageCells(sheet: Sheet, map: MapState, stages: Stages, shown: StepName): void {
  const layers = [
    { name: "expanded", cells: stages.expanded, color: sheet.colors.expanded },
    { name: "closed", cells: stages.closed, color: sheet.colors.closed },
  ] as const;
  const ctx = sheet.inCells(map);
  for (const { name, cells, color } of layers) {
    if (cells === undefined || !isTold(name, shown)) continue;
    const area = new Path2D();
    // A hair wider than a cell, so that no seams show.
    const seam = sheet.px(0.3);
    for (let i = 0; i + 1 < cells.length; i += 2) {
      area.rect(cells[i]! - seam, cells[i + 1]! - seam, 1 + 2 * seam, 1 + 2 * seam);
    }
    ctx.fillStyle = color;
    ctx.fill(area);
  }
}

/** Ways over cells and nodes. */
export function drawStageWays(sheet: Sheet, map: MapState, stages: Stages, shown: StepName): void {
  const { colors } = sheet;
  const ctx = sheet.inCells(map);
  const isBehind = isTold("arcs", shown);
  if (stages.grid_path && isTold("cells", shown)) {
    const isLast = shown === "cells";
    way(sheet, stages.grid_path, isLast ? 2.4 : 1.2, isLast ? [] : [2, 4]);
    dots(sheet, stages.grid_path, isLast ? 2.2 : 1.5);
  }
  if (stages.nodes && isTold("nodes", shown)) {
    way(sheet, stages.nodes, isBehind ? 1.4 : 2.4, isBehind ? [6, 4] : []);
    ctx.fillStyle = colors.page;
    dots(sheet, stages.nodes, isBehind ? 3.2 : 4.6, true);
  }
}

function way(sheet: Sheet, cells: readonly number[], widthPx: number, dashPx: number[]): void {
  const { ctx, colors } = sheet;
  ctx.beginPath();
  addPolyline(
    ctx,
    cells.map((coordinate) => coordinate + 0.5),
  );
  sheet.pen(colors.page, widthPx + 2.6);
  sheet.faint(0.8, () => ctx.stroke());
  sheet.pen(colors.waypoints, widthPx, dashPx);
  ctx.stroke();
}

function dots(sheet: Sheet, cells: readonly number[], radiusPx: number, isRing = false): void {
  const { ctx, colors } = sheet;
  ctx.beginPath();
  for (let i = 0; i + 1 < cells.length; i += 2) {
    const [x, y] = [cells[i]! + 0.5, cells[i + 1]! + 0.5];
    ctx.moveTo(x + sheet.px(radiusPx), y);
    ctx.arc(x, y, sheet.px(radiusPx), 0, 2 * Math.PI);
  }
  ctx.fillStyle = isRing ? colors.page : colors.waypoints;
  ctx.fill();
  if (!isRing) return;
  sheet.pen(colors.waypoints, 2);
  ctx.stroke();
}
