/** A plan shown step by step on the map: obstacles, U-shapes, the path over cells, its nodes, the arcs. */

import "./stepper.css";

import { h, setText } from "./dom";
import { icon } from "./icons";
import { stepsOf, type Step } from "./steps";
import type { State, Store } from "./store";

export class Stepper {
  private readonly open = h(
    "button",
    { type: "button", class: "button quiet stepper-open" },
    icon("steps"),
    "Step by step",
  );
  private readonly card = h("section", {
    class: "stepper-card",
    "aria-label": "The plan step by step",
  });
  private readonly dots = h("ol", { class: "stepper-dots" });
  private readonly title = h("b", {});
  private readonly sentence = h("span", {});
  private readonly back = this.arrow("Previous step", "stepper-back", -1);
  private readonly next = this.arrow("Next step", "stepper-next", 1);
  private shown = "";

  constructor(
    host: HTMLElement,
    private readonly store: Store,
  ) {
    const close = h("button", { type: "button", "aria-label": "End the steps" }, icon("close"));
    close.addEventListener("click", () => this.end());
    this.open.addEventListener("click", () => this.go(0));
    const words = h(
      "p",
      { class: "stepper-words", "aria-live": "polite" },
      this.title,
      " ",
      this.sentence,
    );
    this.card.append(this.dots, close, this.back, words, this.next);
    this.card.addEventListener("keydown", (event) => this.key(event));
    host.append(h("div", { class: "stepper" }, this.open, this.card));
    store.watch(["slots", "shown", "map", "step"], (state) => this.update(state));
  }

  private steps(state: Readonly<State>): Step[] {
    return stepsOf((state.slots[state.shown] ?? state.slots.a).plan, state.map);
  }

  private update(state: Readonly<State>): void {
    const steps = this.steps(state);
    const isShown = state.step !== null && steps.length > 0;
    this.card.hidden = !isShown;
    this.open.hidden = isShown;
    this.open.disabled = steps.length === 0;
    if (!isShown) return;
    const at = Math.min(state.step ?? 0, steps.length - 1);
    const step = steps[at];
    if (step === undefined) return;
    setText(this.title, `${step.title}.`);
    setText(this.sentence, step.sentence);
    this.back.disabled = at === 0;
    this.next.disabled = at === steps.length - 1;
    this.mark(steps, at);
  }

  /** A dot for each step, which leads there. */
  private mark(steps: readonly Step[], at: number): void {
    const key = steps.map(({ name }) => name).join();
    if (key !== this.shown) {
      this.shown = key;
      const dots = steps.map(({ title }, i) => {
        const dot = h("button", {
          type: "button",
          "aria-label": title,
          title,
          onclick: () => this.go(i),
        });
        return h("li", {}, dot);
      });
      this.dots.replaceChildren(...dots);
    }
    this.dots.querySelectorAll("button").forEach((dot, i) => {
      dot.classList.toggle("is-done", i <= at);
      if (i === at) dot.setAttribute("aria-current", "step");
      else dot.removeAttribute("aria-current");
    });
  }

  private go(step: number): void {
    const wasOpen = this.store.state.step !== null;
    this.store.set({ step, frame: null, isPlaying: false });
    // The button that opened it is gone by the next frame.
    if (!wasOpen) requestAnimationFrame(() => requestAnimationFrame(() => this.next.focus()));
  }

  private end(): void {
    this.store.set({ step: null });
    requestAnimationFrame(() => requestAnimationFrame(() => this.open.focus()));
  }

  private key(event: KeyboardEvent): void {
    const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (by !== 0) this.move(by);
    else if (event.key === "Escape") this.end();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  private move(by: number): void {
    const last = this.steps(this.store.state).length - 1;
    this.go(Math.min(Math.max((this.store.state.step ?? 0) + by, 0), last));
  }

  private arrow(label: string, name: string, by: 1 | -1): HTMLButtonElement {
    const onclick = () => this.move(by);
    return h(
      "button",
      { type: "button", class: name, "aria-label": label, title: label, onclick },
      icon("chevron"),
    );
  }
}
