/** Why there is no path, drawn: cells that collide, and the gap that could not be passed. */

import { fixed, meters } from "../format";
import type { Answer } from "../protocol";
import type { MapState } from "../store";
import { ring } from "./marks";
import type { Sheet } from "./sheet";

export function drawFailure(sheet: Sheet, map: MapState, answer: Answer): void {
  const { explanation } = answer;
  if (!explanation) return;
  const { collision, gap } = explanation;
  if (collision) drawCollision(sheet, map, collision.cells);
  if (!gap) return;
  drawGap(sheet, gap.x, gap.y, gap.gap_m);
  ring(
    sheet,
    gap.x,
    gap.y,
    `gap ${meters(gap.gap_m)}, vehicle ${meters(gap.vehicle_width_m)}`,
  );
}

/** The reason for the failure; null if there is a path. */
export function reasonOf(answer: Answer): string | null {
  if (answer.path) return null;
  if (answer.status === "cancelled") return null;
  const { disconnected } = answer.explanation ?? {};
  const reason = answer.reason ?? answer.code;
  // A gap that is drawn says it better.
  if (!disconnected || answer.explanation?.gap) return reason;
  const { disc_radius_m, n_cells_at_start, n_cells_at_goal } = disconnected;
  const measures =
    `start and goal lie apart for a disc of ${fixed(disc_radius_m, 2)} m: ` +
    `${n_cells_at_start} cells about the start, ${n_cells_at_goal} about the goal`;
  return `${reason}; ${measures}`;
}

function drawCollision(sheet: Sheet, map: MapState, cells: readonly [number, number][]): void {
  const ctx = sheet.inCells(map);
  const area = new Path2D();
  for (const [col, row] of cells) area.rect(col, row, 1, 1);
  ctx.fillStyle = sheet.colors.limit;
  sheet.faint(0.7, () => ctx.fill(area));
  // Cells too small to be seen are framed.
  sheet.pen(sheet.colors.limit, 1.2);
  ctx.stroke(area);
}

/** The widest disc that fits the gap. */
function drawGap(sheet: Sheet, x: number, y: number, gapM: number): void {
  const ctx = sheet.inWorld();
  ctx.beginPath();
  ctx.arc(x, y, gapM / 2, 0, 2 * Math.PI);
  ctx.fillStyle = sheet.colors.limit;
  sheet.faint(0.35, () => ctx.fill());
  sheet.pen(sheet.colors.limit, 1);
  ctx.stroke();
}
