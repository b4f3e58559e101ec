/** The layer over the path: the tightest point, the point under the pointer, the driving vehicle. */

import { fixed, meters } from "../format";
import { pointAt, poseOf } from "../trace";
import { drawCar } from "./car";
import { keepOff, label, ring } from "./marks";
import { clearanceAt, poseAt } from "./path_shape";
import type { Scene } from "./scene";
import type { Sheet } from "./sheet";

/** Words keep off what they stand beside. */
export function keepRoom(sheet: Sheet, { state, plan }: Scene): void {
  const { view } = sheet;
  const { start, goal } = state.request;
  for (const [x, y] of [start, goal]) keepOff(sheet, view.toPx(x, y), 7);
  const tightest = plan?.end?.tightest;
  if (tightest && state.layers.clearance) keepOff(sheet, view.toPx(tightest.x, tightest.y), 13);
  const gap = plan?.end?.answer.explanation?.gap;
  if (gap) keepOff(sheet, view.toPx(gap.x, gap.y), 13);
}

export function drawTightest(sheet: Sheet, { state, plan, step }: Scene): void {
  const tightest = state.layers.clearance ? plan?.end?.tightest : null;
  if (!tightest || (step !== null && step.name !== "judged")) return;
  if (!sheet.view.shows(tightest.x, tightest.y)) return;
  ring(sheet, tightest.x, tightest.y, meters(tightest.clearance_m));
}

/** The place of the path that is pointed at, here or in the charts. */
export function drawHover(sheet: Sheet, { state, shape }: Scene): void {
  const { hoverM, vehicle } = state;
  if (hoverM === null || shape === null || vehicle === null) return;
  const pose = poseAt(shape, hoverM);
  drawCar(sheet, vehicle, pose, { color: sheet.colors.ink, fill: 0 });
  const clearance = clearanceAt(shape, hoverM);
  const words = clearance === null ? "" : `, ${meters(clearance)} clear`;
  const [x, y] = sheet.view.toPx(pose[0], pose[1]);
  label(sheet, `at ${fixed(hoverM, 1)} m${words}`, [x, y - 22], sheet.colors.ink, 14);
}

/** The vehicle on its way, the way behind it dotted. */
export function drawDrive(sheet: Sheet, { state, side }: Scene): void {
  const { driven } = side;
  const { vehicle, driveS } = state;
  if (driven === null || driveS === null || vehicle === null) return;
  const ctx = sheet.inWorld();
  ctx.beginPath();
  for (const { t_s, pose } of driven.trace) {
    if (t_s > driveS) break;
    ctx.lineTo(pose.x, pose.y);
  }
  sheet.pen(sheet.colors.ink, 1.6, [2, 4]);
  ctx.stroke();
  const point = pointAt(driven, driveS);
  if (point === null) return;
  const hasFailed = !driven.tracked && driveS >= (driven.trace.at(-1)?.t_s ?? 0);
  drawCar(sheet, vehicle, poseOf(point), {
    color: hasFailed ? sheet.colors.limit : sheet.colors.forward,
    fill: 0.5,
    wheels: [point.left_wheel_rad, point.right_wheel_rad],
  });
  const { contact } = driven;
  if (contact && driveS >= contact.t_s) ring(sheet, contact.x, contact.y, "contact");
}
