/** Start and goal for keyboards and screen readers: a button over each. */

import type { Actions } from "../actions";
import { h } from "../dom";
import { degrees, fixed } from "../format";
import type { Pose, Slot } from "../protocol";
import type { State } from "../store";
import type { View } from "./camera";
import type { End } from "./ends";

const TURN_RAD = Math.PI / 36;
const LARGE_STEP = 10;
const HELP = "Arrow keys move it by one cell, with Shift by ten; R and Shift R turn it by 5 degrees.";

export class Handles {
  private readonly buttons: Record<End, HTMLButtonElement>;
  /** Moved by keys that are not yet up again. */
  private moving: End | null = null;

  constructor(
    host: HTMLElement,
    private readonly view: View,
    private readonly actions: Actions,
    private readonly state: () => Readonly<State>,
    slot: Slot,
  ) {
    const make = (end: End) => {
      const button = h("button", { type: "button", class: "map-handle", "data-end": end });
      button.addEventListener("keydown", (event) => this.key(event, end));
      button.addEventListener("keyup", () => this.settle());
      button.addEventListener("blur", () => this.settle());
      // Of two maps side by side one is enough to go through.
      if (slot === "b") button.tabIndex = -1;
      host.append(button);
      return button;
    };
    this.buttons = { start: make("start"), goal: make("goal") };
  }

  /** Puts the buttons where the ends are. */
  place(): void {
    const { request, map } = this.state();
    for (const end of ["start", "goal"] as const) {
      const button = this.buttons[end];
      const [x, y, heading] = request[end];
      button.hidden = map === null;
      const [px, py] = this.view.toPx(x, y);
      button.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px) translate(-50%, -50%)`;
      const words = `x ${fixed(x, 2)} m, y ${fixed(y, 2)} m, heading ${degrees(heading, 0)}`;
      const label = `${end === "start" ? "Start" : "Goal"}: ${words}. ${HELP}`;
      if (button.getAttribute("aria-label") !== label) button.setAttribute("aria-label", label);
    }
  }

  private key(event: KeyboardEvent, end: End): void {
    const { map, request } = this.state();
    const change = map === null ? null : changeOf(event, map.resolution_m);
    if (change === null || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const [x, y, heading] = request[end];
    const pose: Pose = [x + change[0], y + change[1], heading + change[2]];
    this.moving = end;
    this.actions.moveEnd(end, pose, true);
  }

  private settle(): void {
    const end = this.moving;
    if (end === null) return;
    this.moving = null;
    this.actions.moveEnd(end, this.state().request[end], false);
  }
}

function changeOf(event: KeyboardEvent, resolutionM: number): Pose | null {
  const step = resolutionM * (event.shiftKey ? LARGE_STEP : 1);
  switch (event.key) {
    case "ArrowLeft":
      return [-step, 0, 0];
    case "ArrowRight":
      return [step, 0, 0];
    case "ArrowUp":
      return [0, step, 0];
    case "ArrowDown":
      return [0, -step, 0];
    case "r":
      return [0, 0, TURN_RAD];
    case "R":
      return [0, 0, -TURN_RAD];
    default:
      return null;
  }
}
