/** Selectors of the state that several panels share. */

import type { Answer, Config, PoseRecord, Slot } from "./protocol";
import type { PlanState, SlotState, State } from "./store";

/** The slot that panels edit and charts show. */
export function shownSlot(state: Readonly<State>): SlotState {
  return state.slots[state.shown] ?? state.slots.a;
}

/** The slots that are there, in order. */
export function slotsOf(state: Readonly<State>): [Slot, SlotState][] {
  const { a, b } = state.slots;
  return b
    ? [
        ["a", a],
        ["b", b],
      ]
    : [["a", a]];
}

/** The answer of a slot; null while it plans. */
export function answerOf(slot: SlotState | null): Answer | null {
  return slot?.plan?.end?.answer ?? null;
}

/** The sampled poses of a slot's path; empty without one. */
export function posesOf(slot: SlotState | null): PoseRecord[] {
  return answerOf(slot)?.path?.poses ?? [];
}

/** Whether a plan is under way. */
export function isPlanning(plan: PlanState | null): boolean {
  return plan !== null && plan.end === null;
}

/** The full configuration of a planner as the catalog has it. */
export function presetOf(state: Readonly<State>, planner: string): Config {
  return state.catalog?.planners.find(({ name }) => name === planner)?.config ?? { planner };
}
