/** The visible part of a run: the frames up to the position of playback. */

import type { DriveFrame, GenerationFrame, ImprovedFrame, Slot } from "../protocol";
import type { Frame, PlanState, State } from "../store";

type IterationFrame = Extract<Frame, { type: "iteration" }>;

/** A moment of a run. */
export interface Moment {
  /** The number of frames that have begun; null: the run is over, and its answer is shown. */
  nBegun: number | null;
  /** The progress of the last of them, 0 to 1. */
  share: number;
  path: ImprovedFrame | null;
  iteration: IterationFrame | null;
  generation: GenerationFrame | null;
  drive: DriveFrame | null;
  /** The generation of ants before. */
  driveBefore: DriveFrame | null;
  /** Whether the ants of `drive` are still moving. */
  isDriveLast: boolean;
}

export function momentOf(state: Readonly<State>, slot: Slot): Moment {
  const plan = state.slots[slot]?.plan ?? null;
  const index = plan === null ? null : indexOf(state, slot, plan);
  if (plan === null || index === null) return atEnd(plan);
  const moment: Moment = {
    nBegun: index + 1,
    share: state.frame === null ? 1 : state.frameShare,
    path: null,
    iteration: null,
    generation: null,
    drive: null,
    driveBefore: null,
    isDriveLast: false,
  };
  for (let i = index; i >= 0; i -= 1) fill(moment, plan.frames[i], i === index);
  return moment;
}

/** The frame that is shown; null at the end of a run. */
function indexOf(state: Readonly<State>, slot: Slot, plan: PlanState): number | null {
  const last = plan.frames.length - 1;
  // A run that nobody plays back is seen live.
  if (state.frame === null) return plan.end === null ? last : null;
  const shown = state.slots[state.shown]?.plan;
  if (slot === state.shown || !shown) return Math.min(state.frame, last);
  // Beside the run that is played the other one keeps pace.
  const done = (state.frame + 1) / Math.max(shown.frames.length, 1);
  return Math.min(Math.ceil(done * plan.frames.length) - 1, last);
}

function fill(moment: Moment, frame: Frame | undefined, isLast: boolean): void {
  switch (frame?.type) {
    case "improved":
      moment.path ??= frame;
      break;
    case "iteration":
      moment.iteration ??= frame;
      break;
    case "generation":
      moment.generation ??= frame;
      break;
    case "drive":
      if (moment.drive !== null) moment.driveBefore ??= frame;
      else [moment.drive, moment.isDriveLast] = [frame, isLast];
      break;
  }
}

function atEnd(plan: PlanState | null): Moment {
  const frames = plan?.frames ?? [];
  const iteration = frames.findLast((frame): frame is IterationFrame => frame.type === "iteration");
  return {
    nBegun: null,
    share: 1,
    path: plan?.improved ?? null,
    iteration: iteration ?? null,
    generation: null,
    drive: null,
    driveBefore: null,
    isDriveLast: false,
  };
}
