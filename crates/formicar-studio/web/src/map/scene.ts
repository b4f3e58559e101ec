/** All that the picture of a slot is made from, at a moment. */

import type { Slot } from "../protocol";
import { stepsOf, type Step } from "../steps";
import type { MapState, PlanState, SlotState, State } from "../store";
import { type PathShape, shapeOfAnswer, shapeOfFrame } from "./path_shape";
import { type Moment, momentOf } from "./playhead";

export interface Scene {
  state: Readonly<State>;
  map: MapState;
  side: SlotState;
  plan: PlanState | null;
  moment: Moment;
  /** The step that is shown; null: none. */
  step: Step | null;
  /** The path that is shown. */
  shape: PathShape | null;
}

/** Null if there is nothing to show yet. */
export function sceneOf(state: Readonly<State>, slot: Slot): Scene | null {
  const { map } = state;
  const side = state.slots[slot];
  if (map === null || side === null) return null;
  const { plan } = side;
  const moment = momentOf(state, slot);
  const steps = state.step === null ? [] : stepsOf(plan, map);
  const step = steps[Math.min(state.step ?? 0, steps.length - 1)] ?? null;
  return { state, map, side, plan, moment, step, shape: shapeAt(plan, moment) };
}

/** The path of the answer once it is shown, else the last one on the way there. */
function shapeAt(plan: PlanState | null, moment: Moment): PathShape | null {
  const answer = plan?.end?.answer;
  const ended = moment.nBegun === null && answer ? shapeOfAnswer(answer) : null;
  return ended ?? (moment.path === null ? null : shapeOfFrame(moment.path));
}
