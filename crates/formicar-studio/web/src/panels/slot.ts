/** A label for the slot of a panel; hidden while only one plan is shown. */

import type { Slot } from "../protocol";
import { slotsOf } from "../state";
import type { State, Store } from "../store";
import { Segments } from "./widgets";

export class SlotChoice {
  readonly element: HTMLElement;
  private readonly segments: Segments<Slot>;

  constructor(store: Store) {
    this.segments = new Segments<Slot>(
      "Which plan",
      [
        ["a", "Plan A"],
        ["b", "Plan B"],
      ],
      (shown) => store.set({ shown }),
    );
    this.element = this.segments.element;
    this.element.classList.add("slot-choice");
  }

  show(state: Readonly<State>): void {
    this.element.hidden = slotsOf(state).length < 2;
    this.segments.show(state.shown);
  }
}
