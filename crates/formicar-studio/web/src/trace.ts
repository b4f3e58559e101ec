/** The pose of the vehicle at a time of a drive. */

import type { DrivenMessage, Pose } from "./protocol";

export type TracePoint = DrivenMessage["trace"][number];

/** The duration of a drive, seconds. */
export function durationS(driven: DrivenMessage): number {
  return driven.trace.at(-1)?.t_s ?? 0;
}

/** The index of the last point that is not later than `timeS`. */
export function indexAt(trace: readonly TracePoint[], timeS: number): number {
  let [low, high] = [0, trace.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((trace[middle]?.t_s ?? Infinity) <= timeS) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** The point of a drive at a time, between two of the trace where it falls between; null without
 * a trace. */
export function pointAt(driven: DrivenMessage, timeS: number): TracePoint | null {
  const { trace } = driven;
  const index = indexAt(trace, timeS);
  const [a, b] = [trace[index], trace[index + 1]];
  if (a === undefined) return null;
  if (b === undefined || timeS <= a.t_s) return a;
  const t = (timeS - a.t_s) / Math.max(b.t_s - a.t_s, 1e-9);
  const between = (from: number, to: number) => from + t * (to - from);
  const heading = a.pose.heading + t * wrapped(b.pose.heading - a.pose.heading);
  return {
    t_s: timeS,
    driven_m: between(a.driven_m, b.driven_m),
    s_m: between(a.s_m, b.s_m),
    pose: { x: between(a.pose.x, b.pose.x), y: between(a.pose.y, b.pose.y), heading },
    direction: a.direction,
    steer_rad: between(a.steer_rad, b.steer_rad),
    left_wheel_rad: between(a.left_wheel_rad, b.left_wheel_rad),
    right_wheel_rad: between(a.right_wheel_rad, b.right_wheel_rad),
    cross_track_error_m: between(a.cross_track_error_m, b.cross_track_error_m),
    heading_error_rad: between(a.heading_error_rad, b.heading_error_rad),
  };
}

/** An angle between -pi and pi. */
export function wrapped(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}

export function poseOf(point: TracePoint): Pose {
  return [point.pose.x, point.pose.y, point.pose.heading];
}
