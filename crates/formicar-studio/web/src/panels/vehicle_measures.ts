/** Measures of a vehicle as they are drawn, and what dragging a handle makes of them. */

import type { VehicleMessage, VehicleParameters } from "../protocol";

const LEAST_M = 0.05;
const MOST_STEER = 1.35;

/** The measures that are drawn, meters and radians, about the center of the rear axle. */
export interface Measures {
  corners: [number, number][];
  wheelbase: number | null;
  track: number | null;
  steer: number | null;
  radius: number | null;
}

export type Handle = "front" | "rear" | "axle" | "side" | "steer";

export function measuresOf(vehicle: VehicleMessage): Measures {
  return {
    corners: vehicle.footprint,
    wheelbase: vehicle.wheelbase_m,
    track: vehicle.track_width_m,
    steer: vehicle.max_steer_rad,
    radius: vehicle.min_turning_radius_m,
  };
}

/** The vehicle as a rectangle with its steering angle, whatever its file gives. */
export function rectangleOf(vehicle: VehicleMessage): Record<string, number> {
  const [x0, x1, y0, y1] = bounds(vehicle.footprint);
  const wheelbase = vehicle.wheelbase_m ?? x1;
  return {
    wheelbase_m: wheelbase,
    front_overhang_m: x1 - wheelbase,
    rear_overhang_m: -x0,
    width_m: y1 - y0,
    max_steer_rad: vehicle.max_steer_rad ?? 0,
  };
}

export function previewOf(parameters: VehicleParameters): Measures {
  const of = (key: string): number => Number(parameters[key] ?? 0);
  const [x0, x1] = [-of("rear_overhang_m"), of("wheelbase_m") + of("front_overhang_m")];
  const half = of("width_m") / 2;
  const steer = of("max_steer_rad");
  return {
    corners: [
      [x0, -half],
      [x1, -half],
      [x1, half],
      [x0, half],
    ],
    wheelbase: of("wheelbase_m"),
    track: null,
    steer,
    radius: steer > 0 ? of("wheelbase_m") / Math.tan(steer) : null,
  };
}

/** The measures after a handle is dragged to `place`. */
export function moved(
  which: Handle,
  start: Record<string, number>,
  [x, y]: [number, number],
): Record<string, number> {
  const wheelbase = start.wheelbase_m ?? 0;
  const front = wheelbase + (start.front_overhang_m ?? 0);
  switch (which) {
    case "front":
      return { front_overhang_m: rounded(Math.max(0, x - wheelbase)) };
    case "rear":
      return { rear_overhang_m: rounded(Math.max(0, -x)) };
    case "axle": {
      const place = rounded(Math.min(Math.max(LEAST_M, x), front));
      return { wheelbase_m: place, front_overhang_m: rounded(front - place) };
    }
    case "side":
      return { width_m: rounded(Math.max(LEAST_M, 2 * y)) };
    case "steer": {
      const angle = Math.atan2(y, Math.max(x - wheelbase, 1e-6));
      return { max_steer_rad: Math.min(Math.max(0.02, angle), MOST_STEER) };
    }
  }
}

/** Only what the handle changed, steering in whole half degrees. */
export function asParameters(
  which: Handle,
  values: VehicleParameters,
  vehicle: VehicleMessage,
): VehicleParameters {
  if (which === "steer") {
    return { max_steer_deg: Math.round((2 * Number(values.max_steer_rad) * 180) / Math.PI) / 2 };
  }
  const keys = {
    front: ["front_overhang_m"],
    rear: ["rear_overhang_m"],
    axle: ["wheelbase_m", "front_overhang_m"],
    side: ["width_m"],
  }[which];
  const measured = Object.fromEntries(keys.map((key) => [key, values[key]]));
  const track = Number(vehicle.parameters.track_width_m ?? 0);
  // Wheels stay under the body.
  return which === "side" && track > Number(values.width_m)
    ? { ...measured, track_width_m: null }
    : measured;
}

/** Steering angles of the left and the right front wheel. */
export function ackermann(steer: number, wheelbase: number, half: number): [number, number] {
  const radius = wheelbase / Math.tan(steer);
  return [Math.atan(wheelbase / (radius - half)), Math.atan(wheelbase / (radius + half))];
}

export function bounds(corners: readonly [number, number][]): [number, number, number, number] {
  const xs = corners.map(([x]) => x);
  const ys = corners.map(([, y]) => y);
  return [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
}

function rounded(value: number): number {
  return Math.round(value * 100) / 100;
}
