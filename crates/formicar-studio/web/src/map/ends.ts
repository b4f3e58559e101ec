/** Start and goal with their heading arrows, and what of them lies under a finger. */

import type { Pose, Request, VehicleMessage, Via } from "../protocol";
import type { Point, View } from "./camera";
import { drawCar } from "./car";
import { label } from "./marks";
import type { Sheet } from "./sheet";

export type End = "start" | "goal";

/** A part of an end that can be dragged. */
export interface Grip {
  end: End;
  part: "body" | "heading";
}

const ENDS: readonly End[] = ["goal", "start"];
/** Arrows are at least this long, and so stand out ahead of small vehicles. */
const MIN_ARROW_PX = 40;
const BEYOND_FRONT_PX = 16;
const GRIP_PX = 6.5;
const VIA_PX = 7;

export function drawEnds(
  sheet: Sheet,
  request: Request,
  vehicle: VehicleMessage | null,
  held: Grip | null,
): void {
  for (const goal of request.goals ?? []) drawDot(sheet, goal, "goal", false);
  for (const [i, via] of (request.via ?? []).entries()) drawVia(sheet, via, `${i + 1}`);
  for (const end of ENDS) {
    const color = end === "start" ? sheet.colors.start : sheet.colors.goal;
    const pose = request[end];
    if (vehicle !== null)
      drawCar(sheet, vehicle, pose, { color, fill: end === "start" ? 0.4 : 0.16 });
    const isFree = headingOf(request, end) === "any";
    if (vehicle?.motion !== "point") {
      drawArrow(sheet, pose, vehicle, {
        color,
        isFree,
        isHeld: held?.end === end && held.part === "heading",
      });
    }
    drawDot(sheet, pose, end, held?.end === end && held.part === "body");
    if (sheet.view.shows(pose[0], pose[1]))
      label(sheet, end, sheet.view.toPx(pose[0], pose[1]), color, 12);
  }
}

/** The end within reach of a point; the arrow's tip wins, then the nearest. */
export function gripAt(
  view: View,
  request: Request,
  vehicle: VehicleMessage | null,
  at: Point,
  reachPx: number,
): Grip | null {
  const distance = ([x, y]: Point) => Math.hypot(x - at[0], y - at[1]);
  const grips = ENDS.flatMap((end): { grip: Grip; px: number }[] => {
    const pose = request[end];
    const body = {
      grip: { end, part: "body" } as const,
      px: bodyDistancePx(view, pose, vehicle, at),
    };
    if (vehicle?.motion === "point") return [body];
    const tip = tipPx(view, pose, vehicle);
    return [{ grip: { end, part: "heading" }, px: distance(tip) - GRIP_PX - 2 }, body];
  });
  const near = grips.filter(({ px }) => px <= reachPx).sort((a, b) => a.px - b.px);
  return near[0]?.grip ?? null;
}

/** The tip of an end's arrow. */
export function tipPx(view: View, pose: Pose, vehicle: VehicleMessage | null): Point {
  const [x, y] = view.toPx(pose[0], pose[1]);
  const reach = reachPx(view, vehicle);
  return [x + reach * Math.cos(pose[2]), y - reach * Math.sin(pose[2])];
}

/** The distance of a point from the body, pixels; 0 within it. */
function bodyDistancePx(view: View, pose: Pose, vehicle: VehicleMessage | null, at: Point): number {
  const [x, y] = view.toWorld(at);
  const [cos, sin] = [Math.cos(pose[2]), Math.sin(pose[2])];
  const [u, v] = [
    cos * (x - pose[0]) + sin * (y - pose[1]),
    cos * (y - pose[1]) - sin * (x - pose[0]),
  ];
  const xs = vehicle?.footprint.map(([fx]) => fx) ?? [0];
  const ys = vehicle?.footprint.map(([, fy]) => fy) ?? [0];
  const beyond = (value: number, all: number[]) =>
    Math.max(Math.min(0, ...all) - value, value - Math.max(0, ...all), 0);
  const px = Math.hypot(beyond(u, xs), beyond(v, ys)) * view.pxPerM;
  // The dot counts too, on vehicles smaller than it.
  return Math.min(px, Math.max(Math.hypot(u, v) * view.pxPerM - 6, 0));
}

function headingOf(request: Request, end: End): string {
  return (end === "start" ? request.start_heading : request.goal_heading) ?? "exact";
}

function reachPx(view: View, vehicle: VehicleMessage | null): number {
  const front = Math.max(0, ...(vehicle?.footprint.map(([x]) => x) ?? []));
  return Math.max(front * view.pxPerM + BEYOND_FRONT_PX, MIN_ARROW_PX);
}

function drawArrow(
  sheet: Sheet,
  pose: Pose,
  vehicle: VehicleMessage | null,
  look: { color: string; isFree: boolean; isHeld: boolean },
): void {
  const { view, colors } = sheet;
  const ctx = sheet.inPixels();
  const [x, y] = view.toPx(pose[0], pose[1]);
  const [tipX, tipY] = tipPx(view, pose, vehicle);
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(tipX, tipY);
  sheet.pen(colors.page, 5);
  sheet.faint(0.8, () => ctx.stroke());
  sheet.pen(look.color, 2.2, look.isFree ? [3, 3] : []);
  ctx.stroke();
  ctx.translate(tipX, tipY);
  ctx.rotate(-pose[2]);
  ctx.beginPath();
  ctx.moveTo(GRIP_PX + 3, 0);
  ctx.lineTo(-GRIP_PX, GRIP_PX);
  ctx.lineTo(-GRIP_PX + 3, 0);
  ctx.lineTo(-GRIP_PX, -GRIP_PX);
  ctx.closePath();
  sheet.pen(colors.page, 3);
  ctx.stroke();
  ctx.fillStyle = look.color;
  ctx.fill();
  if (!look.isHeld) return;
  ctx.beginPath();
  ctx.arc(0, 0, GRIP_PX + 7, 0, 2 * Math.PI);
  sheet.pen(look.color, 1.5);
  ctx.stroke();
}

/** A diamond with its place in the order, and a line ahead where the heading is asked for. */
function drawVia(sheet: Sheet, { at, heading }: Via, place: string): void {
  const { view, colors } = sheet;
  const ctx = sheet.inPixels();
  const [x, y] = view.toPx(at[0], at[1]);
  ctx.beginPath();
  ctx.moveTo(x, y - VIA_PX);
  ctx.lineTo(x + VIA_PX, y);
  ctx.lineTo(x, y + VIA_PX);
  ctx.lineTo(x - VIA_PX, y);
  ctx.closePath();
  ctx.fillStyle = colors.page;
  ctx.fill();
  if (heading !== undefined) {
    ctx.moveTo(x, y);
    ctx.lineTo(x + 3 * VIA_PX * Math.cos(heading), y - 3 * VIA_PX * Math.sin(heading));
  }
  sheet.pen(colors.goal, 2.2);
  ctx.stroke();
  if (view.shows(at[0], at[1])) label(sheet, place, [x, y], colors.goal, VIA_PX + 3);
}

/** A filled disc at the start, a ring at the goal. */
function drawDot(sheet: Sheet, pose: Pose, end: End, isHeld: boolean): void {
  const { colors } = sheet;
  const color = end === "start" ? colors.start : colors.goal;
  const ctx = sheet.inPixels();
  const [x, y] = sheet.view.toPx(pose[0], pose[1]);
  ctx.beginPath();
  ctx.arc(x, y, 5, 0, 2 * Math.PI);
  ctx.fillStyle = end === "start" ? color : colors.page;
  ctx.fill();
  sheet.pen(end === "start" ? colors.page : color, end === "start" ? 1.2 : 2.6);
  ctx.stroke();
  if (!isHeld) return;
  ctx.beginPath();
  ctx.arc(x, y, 13, 0, 2 * Math.PI);
  sheet.pen(color, 1.5);
  ctx.stroke();
}
