/** Display times of the frames of a run: a steady rate, however fast the run was. */

import type { Frame } from "./store";

/** Milliseconds by kind, if the budget allows. */
const BASE_MS: Record<Frame["type"], number> = {
  iteration: 120,
  generation: 120,
  drive: 1000,
  expanded: 70,
  improved: 300,
};

/** Most milliseconds of a run up to its first path, and from there on. */
interface Budget {
  searchMs: number;
  improvementMs: number;
}

/** A run that begins by itself: the first path is there after a second. Colonies, which have it
 * only at their end, get more. */
const LIVE: Budget = { searchMs: 1000, improvementMs: 2200 };
const LIVE_COLONY: Budget = { searchMs: 6000, improvementMs: 1000 };
/** A run that somebody plays. */
const PLAYED: Budget = { searchMs: 9000, improvementMs: 9000 };

/** Display time of a frame, milliseconds. */
export function durationMs(frames: readonly Frame[], index: number, isLive: boolean): number {
  const frame = frames[index];
  if (frame === undefined) return 0;
  const first = frames.findIndex(({ type }) => type === "improved");
  const nSearch = first < 0 ? frames.length : first;
  const isSearch = index < nSearch;
  const part = isSearch ? frames.slice(0, nSearch) : frames.slice(nSearch);
  const wantedMs = part.reduce((sum, { type }) => sum + BASE_MS[type], 0);
  const isColony = frames.some(({ type }) => type === "iteration" || type === "generation");
  const budget = isLive ? (isColony ? LIVE_COLONY : LIVE) : PLAYED;
  const mostMs = isSearch ? budget.searchMs : budget.improvementMs;
  return BASE_MS[frame.type] * Math.min(1, mostMs / wantedMs);
}
