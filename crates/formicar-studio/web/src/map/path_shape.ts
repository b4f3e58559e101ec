/** A path as the map draws it, from an answer or from a path on the way to it. */

import type { Answer, ImprovedFrame, Pose } from "../protocol";

/** Samples of a path, one entry each. */
export interface PathShape {
  n: number;
  x: Float64Array;
  y: Float64Array;
  heading: Float64Array;
  /** Arc length from the start, meters. */
  s: Float64Array;
  /** Clearance in meters, if known. */
  clearance: Float64Array | null;
  /** Stretches of one gear: the first and the last sample of each. */
  runs: { from: number; to: number; gear: 1 | -1 }[];
}

const ofAnswers = new WeakMap<Answer, PathShape>();
const ofFrames = new WeakMap<ImprovedFrame, PathShape>();

export function shapeOfAnswer(answer: Answer): PathShape | null {
  const poses = answer.path?.poses;
  if (!poses || poses.length === 0) return null;
  const known = ofAnswers.get(answer);
  if (known) return known;
  const shape: PathShape = {
    n: poses.length,
    x: Float64Array.from(poses, (pose) => pose.x),
    y: Float64Array.from(poses, (pose) => pose.y),
    heading: Float64Array.from(poses, (pose) => pose.heading),
    s: Float64Array.from(poses, (pose) => pose.s),
    clearance: Float64Array.from(poses, (pose) => pose.clearance),
    runs: runsOf(poses.map((pose) => pose.direction)),
  };
  ofAnswers.set(answer, shape);
  return shape;
}

export function shapeOfFrame(frame: ImprovedFrame): PathShape {
  const known = ofFrames.get(frame);
  if (known) return known;
  const n = frame.poses.length >> 2;
  const column = (offset: number) =>
    Float64Array.from({ length: n }, (_, i) => frame.poses[4 * i + offset] ?? 0);
  const [x, y, heading] = [column(0), column(1), column(2)];
  const s = new Float64Array(n);
  for (let i = 1; i < n; i += 1)
    s[i] = s[i - 1]! + Math.hypot(x[i]! - x[i - 1]!, y[i]! - y[i - 1]!);
  // Chords are a little shorter than the arcs: the end is made to fit, so that charts agree.
  const stretch = n > 1 && s[n - 1]! > 0 ? frame.length_m / s[n - 1]! : 1;
  for (let i = 0; i < n; i += 1) s[i] = s[i]! * stretch;
  const gears = Array.from(column(3), (gear): 1 | -1 => (gear < 0 ? -1 : 1));
  const shape = { n, x, y, heading, s, clearance: null, runs: runsOf(gears) };
  ofFrames.set(frame, shape);
  return shape;
}

/** The gear of a sample is that of the way to it. */
function runsOf(gears: readonly (1 | -1)[]): PathShape["runs"] {
  const runs: PathShape["runs"] = [];
  for (let i = 1; i < gears.length; i += 1) {
    const last = runs.at(-1);
    const gear = gears[i] ?? 1;
    if (last?.gear === gear) last.to = i;
    else runs.push({ from: i - 1, to: i, gear });
  }
  return runs;
}

/** The pose at an arc length, between two samples. */
export function poseAt(shape: PathShape, s: number): Pose {
  const b = Math.min(Math.max(firstBeyond(shape.s, s), 1), Math.max(shape.n - 1, 0));
  const a = Math.max(b - 1, 0);
  const span = shape.s[b]! - shape.s[a]!;
  const t = span > 0 ? Math.min(Math.max((s - shape.s[a]!) / span, 0), 1) : 0;
  const turn = shape.heading[b]! - shape.heading[a]!;
  return [
    shape.x[a]! + t * (shape.x[b]! - shape.x[a]!),
    shape.y[a]! + t * (shape.y[b]! - shape.y[a]!),
    shape.heading[a]! + t * Math.atan2(Math.sin(turn), Math.cos(turn)),
  ];
}

/** The clearance at an arc length; null if unknown. */
export function clearanceAt(shape: PathShape, s: number): number | null {
  if (shape.clearance === null) return null;
  const b = Math.min(firstBeyond(shape.s, s), shape.n - 1);
  return shape.clearance[b] ?? null;
}

/** The arc length nearest to a place, and how far it is off, meters. */
export function nearestOn(
  shape: PathShape,
  x: number,
  y: number,
): { s: number; distance_m: number } {
  let best = { s: 0, distance_m: Infinity };
  for (let i = 1; i < shape.n; i += 1) {
    const [ax, ay] = [shape.x[i - 1]!, shape.y[i - 1]!];
    const [dx, dy] = [shape.x[i]! - ax, shape.y[i]! - ay];
    const squared = dx * dx + dy * dy;
    const t = squared > 0 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / squared, 0), 1) : 0;
    const distance_m = Math.hypot(x - ax - t * dx, y - ay - t * dy);
    if (distance_m < best.distance_m) {
      best = { s: shape.s[i - 1]! + t * (shape.s[i]! - shape.s[i - 1]!), distance_m };
    }
  }
  return best;
}

function firstBeyond(sorted: Float64Array, value: number): number {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle]! < value) low = middle + 1;
    else high = middle;
  }
  return low;
}
