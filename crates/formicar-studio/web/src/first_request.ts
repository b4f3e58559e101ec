/** A start and a goal for maps that come without: free places near two opposite corners. */

import { toCells, toWorld } from "./cells";
import type { Pose, VehicleMessage } from "./protocol";
import type { MapState } from "./store";

/** Values from here on block. */
const OCCUPIED = 100;
/** Places are looked for on this many radii and bearings about the wanted one. */
const N_RADII = 60;
const N_BEARINGS = 24;

export function firstRequest(
  map: MapState,
  vehicle: VehicleMessage | null,
): { start: Pose; goal: Pose } {
  const [fromCol, fromRow] = [0.15 * map.n_cols, 0.15 * map.n_rows];
  const [toCol, toRow] = [0.85 * map.n_cols, 0.85 * map.n_rows];
  return {
    start: freePose(map, vehicle, toWorld(map, fromCol, fromRow)),
    goal: freePose(map, vehicle, toWorld(map, toCol, toRow)),
  };
}

/** The free pose nearest to a point, of four headings; the point itself if none is found. */
function freePose(map: MapState, vehicle: VehicleMessage | null, [x, y]: [number, number]): Pose {
  const reach = 0.5 * Math.max(map.n_cols, map.n_rows) * map.resolution_m;
  const headings = [0, Math.PI / 2, Math.PI, -Math.PI / 2];
  for (let ring = 0; ring < N_RADII; ring += 1) {
    const radius = reach * (ring / N_RADII) ** 1.5;
    for (let i = 0; i < (ring === 0 ? 1 : N_BEARINGS); i += 1) {
      const bearing = (2 * Math.PI * i) / N_BEARINGS;
      const place = [x + radius * Math.cos(bearing), y + radius * Math.sin(bearing)] as const;
      for (const heading of headings) {
        const pose: Pose = [place[0], place[1], heading];
        if (isFree(map, vehicle, pose)) return pose;
      }
    }
  }
  return [x, y, 0];
}

/** Whether the footprint, looked at every half cell, lies on free cells. */
function isFree(map: MapState, vehicle: VehicleMessage | null, [x, y, heading]: Pose): boolean {
  const footprint = vehicle?.motion === "car" ? vehicle.footprint : [];
  const xs = footprint.map(([u]) => u);
  const ys = footprint.map(([, v]) => v);
  // A little more than the body, so that the vehicle can move off.
  const room = 1.2 * map.resolution_m;
  const [low, high] = [Math.min(0, ...xs) - room, Math.max(0, ...xs) + room];
  const [right, left] = [Math.min(0, ...ys) - room, Math.max(0, ...ys) + room];
  const step = 0.5 * map.resolution_m;
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  for (let u = low; u <= high + step; u += step) {
    for (let v = right; v <= left + step; v += step) {
      if (!isFreeAt(map, x + cos * u - sin * v, y + sin * u + cos * v)) return false;
    }
  }
  return true;
}

function isFreeAt(map: MapState, x: number, y: number): boolean {
  const [col, row] = toCells(map, x, y).map(Math.floor) as [number, number];
  if (col < 0 || row < 0 || col >= map.n_cols || row >= map.n_rows) return false;
  const value = map.values[row * map.n_cols + col] ?? -1;
  return value >= 0 && value < OCCUPIED;
}
