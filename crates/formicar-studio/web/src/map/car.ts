/** The vehicle as it stands or drives, with its wheels. */

import type { Pose, VehicleMessage } from "../protocol";
import { addFootprint, lengthOf } from "./path";
import type { Sheet } from "./sheet";

/** Shorter vehicles are drawn without wheels. */
const WHEELS_FROM_PX = 16;

export interface CarLook {
  color: string;
  /** Opacity of the body; 0: its outline alone. */
  fill: number;
  /** Angles of the front wheels, left and right. */
  wheels?: [number, number];
}

/** Draws the vehicle at a pose. */
export function drawCar(sheet: Sheet, vehicle: VehicleMessage, pose: Pose, look: CarLook): void {
  const ctx = sheet.inWorld();
  const [x, y, heading] = pose;
  ctx.translate(x, y);
  ctx.rotate(heading);
  if (vehicle.motion === "point" || vehicle.footprint.length < 3) {
    drawPoint(sheet, look);
    return;
  }
  const isLarge = lengthOf(vehicle) * sheet.view.pxPerM >= WHEELS_FROM_PX;
  const body = new Path2D();
  addFootprint(body, vehicle.footprint, 0, 0, 0);
  ctx.fillStyle = sheet.colors.page;
  // What is only pointed at hides nothing.
  if (look.fill > 0) sheet.faint(0.55, () => ctx.fill(body));
  if (isLarge && look.fill > 0) drawWheels(sheet, vehicle, look);
  ctx.fillStyle = look.color;
  sheet.faint(look.fill, () => ctx.fill(body));
  sheet.pen(look.color, isLarge ? 1.8 : 1.2);
  ctx.stroke(body);
  if (isLarge) drawWindscreen(sheet, vehicle, look);
}

function drawPoint(sheet: Sheet, look: CarLook): void {
  const { ctx } = sheet;
  ctx.beginPath();
  ctx.arc(0, 0, sheet.px(7), 0, 2 * Math.PI);
  ctx.fillStyle = look.color;
  sheet.faint(Math.max(look.fill, 0.5), () => ctx.fill());
  sheet.pen(look.color, 1.8);
  ctx.stroke();
}

function drawWheels(sheet: Sheet, vehicle: VehicleMessage, look: CarLook): void {
  const { ctx, colors } = sheet;
  const { minY, maxY } = extent(vehicle);
  const wheelbase = vehicle.wheelbase_m ?? 0;
  if (wheelbase <= 0) return;
  const half = 0.5 * Math.min(vehicle.track_width_m ?? 0.8 * (maxY - minY), 0.86 * (maxY - minY));
  const size: [number, number] = [0.26 * wheelbase, 0.11 * (maxY - minY)];
  const [left, right] = look.wheels ?? [0, 0];
  const wheels = [
    [0, half, 0],
    [0, -half, 0],
    [wheelbase, half, left],
    [wheelbase, -half, right],
  ] as const;
  ctx.fillStyle = colors.ink;
  for (const [x, y, angle] of wheels) {
    const wheel = new Path2D();
    const [u, v] = [size[0] / 2, size[1] / 2];
    addFootprint(
      wheel,
      [
        [u, v],
        [-u, v],
        [-u, -v],
        [u, -v],
      ],
      x,
      y,
      angle,
    );
    ctx.fill(wheel);
  }
}

/** A line behind the front axle: it shows which end is the front. */
function drawWindscreen(sheet: Sheet, vehicle: VehicleMessage, look: CarLook): void {
  const { ctx } = sheet;
  const { minX, maxX, minY, maxY } = extent(vehicle);
  const [x, bow] = [minX + 0.66 * (maxX - minX), 0.07 * (maxX - minX)];
  const half = 0.36 * (maxY - minY);
  const middle = (minY + maxY) / 2;
  ctx.beginPath();
  ctx.moveTo(x, middle - half);
  ctx.quadraticCurveTo(x + bow, middle, x, middle + half);
  sheet.pen(look.color, 1.8);
  ctx.stroke();
}

function extent(vehicle: VehicleMessage): {
  minX: number;
  maxX: number;
  minY: number;
  maxY: number;
} {
  const xs = vehicle.footprint.map(([x]) => x);
  const ys = vehicle.footprint.map(([, y]) => y);
  return {
    minX: Math.min(...xs),
    maxX: Math.max(...xs),
    minY: Math.min(...ys),
    maxY: Math.max(...ys),
  };
}
