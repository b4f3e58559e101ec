/** The timeline of a run: play, pause, step and scrub. */

import "./playback.css";

import { h, setText } from "./dom";
import { count, fixed, meters, plural } from "./format";
import { icon } from "./icons";
import { isTyping } from "./map/keys";
import { durationMs } from "./pace";
import type { IterationRecord } from "./protocol";
import type { Frame, PlanState, State, Store } from "./store";

/** The button that the space bar presses. */
const PRESSED = "button, a, summary, [role=tab], input[type=checkbox], input[type=radio]";
const SPEEDS = [0.25, 0.5, 1, 2, 4] as const;
/** A longer pause between two looks at the clock: the page was hidden. */
const MAX_TICK_MS = 100;

export class Playback {
  private readonly play = h("button", { type: "button", class: "player-play" });
  private readonly back = stepButton("Step back", "player-back", () => this.step(-1));
  private readonly ahead = stepButton("Step ahead", "player-ahead", () => this.step(1));
  private readonly slider = h("input", {
    type: "range",
    min: 0,
    step: 1,
    "aria-label": "Position in the run",
  });
  private readonly marks = h("div", { class: "player-marks", "aria-hidden": true });
  private readonly words = h("p", { class: "player-words" });
  private readonly speed = h(
    "select",
    { "aria-label": "Playback speed" },
    ...SPEEDS.map((speed) => h("option", { value: speed }, `${speed}\u00d7`)),
  );
  /** Whether the run began to play by itself. */
  private isLive = true;
  private isTicking = false;
  private lastMs = 0;
  private marked = "";

  constructor(
    host: HTMLElement,
    private readonly store: Store,
  ) {
    this.speed.value = "1";
    const track = h("div", { class: "player-track" }, this.marks, this.slider);
    const bar = h(
      "div",
      { class: "player", role: "group", "aria-label": "Playback of the run" },
      h("div", { class: "player-buttons" }, this.back, this.play, this.ahead),
      track,
      this.speed,
      this.words,
    );
    host.append(bar);
    this.play.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    document.addEventListener("keydown", (event) => this.key(event));
    store.watch(["slots", "shown", "frame", "isPlaying"], (state) => this.update(state));
  }

  private get plan(): PlanState | null {
    const { slots, shown } = this.store.state;
    return (slots[shown] ?? slots.a).plan;
  }

  private toggle(): void {
    const { isPlaying, frame } = this.store.state;
    this.isLive = false;
    if (isPlaying) this.store.set({ isPlaying: false });
    else if (this.plan?.frames.length) {
      this.store.set({
        isPlaying: true,
        frame: frame ?? 0,
        frameShare: frame === null ? 0 : this.store.state.frameShare,
        step: null,
      });
    }
  }

  private step(by: 1 | -1): void {
    const n = this.plan?.frames.length ?? 0;
    this.show((this.store.state.frame ?? n) + by);
  }

  /** Stops at a frame; beyond the last one stands the end. */
  private show(index: number): void {
    const n = this.plan?.frames.length ?? 0;
    const frame = index >= n ? null : Math.max(index, 0);
    this.isLive = false;
    this.store.set({ frame, frameShare: 1, isPlaying: false, step: null });
  }

  private key(event: KeyboardEvent): void {
    const { target } = event;
    if (isTyping(target) || event.defaultPrevented || event.ctrlKey || event.metaKey) return;
    const isPress = target instanceof HTMLElement && target.closest(PRESSED);
    if (event.key === " " && !isPress) this.toggle();
    else if (event.key === ",") this.step(-1);
    else if (event.key === ".") this.step(1);
    else return;
    event.preventDefault();
  }

  private update(state: Readonly<State>): void {
    const frames = this.plan?.frames ?? [];
    const n = frames.length;
    for (const element of [this.play, this.back, this.ahead, this.slider])
      element.disabled = n === 0;
    this.back.disabled ||= state.frame === 0;
    this.ahead.disabled ||= state.frame === null;
    setPlaying(this.play, state.isPlaying);
    this.slider.max = String(n);
    this.slider.value = String(state.frame ?? n);
    const shown = state.frame ?? n;
    this.slider.style.setProperty("--done", n > 0 ? `${(100 * shown) / n}%` : "0%");
    const words = wordsOf(this.plan, state.frame);
    setText(this.words, words);
    this.slider.setAttribute("aria-valuetext", words);
    this.mark(frames);
    if (state.isPlaying && !this.isTicking) this.begin();
  }

  /** Ticks where paths came. */
  private mark(frames: readonly Frame[]): void {
    const at = frames.flatMap(({ type }, i) => (type === "improved" ? [i] : []));
    const key = `${frames.length}:${at.join()}`;
    if (key === this.marked) return;
    this.marked = key;
    const ticks = at.map((i) => {
      const tick = h("i", {});
      tick.style.left = `${(100 * i) / frames.length}%`;
      return tick;
    });
    this.marks.replaceChildren(...ticks);
  }

  private begin(): void {
    this.isTicking = true;
    this.lastMs = performance.now();
    requestAnimationFrame(() => this.tick());
  }

  private tick(): void {
    const { store, plan } = this;
    if (!store.state.isPlaying || plan === null) {
      this.isTicking = false;
      this.isLive = true;
      return;
    }
    const now = performance.now();
    this.advance(plan, Math.min(now - this.lastMs, MAX_TICK_MS) * Number(this.speed.value));
    this.lastMs = now;
    requestAnimationFrame(() => this.tick());
  }

  private advance(plan: PlanState, elapsedMs: number): void {
    const { frames } = plan;
    let frame = this.store.state.frame ?? 0;
    let leftMs = elapsedMs;
    let share = this.store.state.frameShare;
    while (frame < frames.length) {
      const lastsMs = durationMs(frames, frame, this.isLive);
      const restMs = lastsMs * (1 - share);
      if (leftMs < restMs) {
        this.store.set({ frame, frameShare: share + leftMs / lastsMs });
        return;
      }
      // At the last frame so far of a run under way it waits for the next.
      if (frame === frames.length - 1 && plan.end === null) {
        this.store.set({ frame, frameShare: 1 });
        return;
      }
      leftMs -= restMs;
      [frame, share] = [frame + 1, 0];
    }
    if (plan.end !== null) this.store.set({ frame: null, frameShare: 0, isPlaying: false });
  }
}

function stepButton(label: string, name: string, onclick: () => void): HTMLButtonElement {
  return h(
    "button",
    { type: "button", class: name, "aria-label": label, title: label, onclick },
    icon("chevron"),
  );
}

function setPlaying(button: HTMLButtonElement, isPlaying: boolean): void {
  const label = isPlaying ? "Pause" : "Play the run";
  if (button.getAttribute("aria-label") === label) return;
  button.setAttribute("aria-label", label);
  button.title = `${label} (space)`;
  button.replaceChildren(icon(isPlaying ? "pause" : "play"));
}

/** A description of a frame. */
function wordsOf(plan: PlanState | null, index: number | null): string {
  if (plan === null) return "No run yet";
  const { frames, end } = plan;
  if (index === null) {
    const nPaths = frames.filter(({ type }) => type === "improved").length;
    if (end === null) return "Under way";
    return nPaths > 1
      ? `End of the run: ${plural(nPaths, "certified path")}, each better`
      : "End of the run";
  }
  const frame = frames[index];
  if (frame === undefined) return "Waiting for the first frame";
  switch (frame.type) {
    case "iteration":
      return recordWords("iteration", frame.record);
    case "generation":
      return recordWords("generation", frame.record);
    case "drive":
      return `generation ${frame.generation + 1}: ${plural(frame.arrived.length, "ant")} arrived, ${count(frame.died.length)} died`;
    case "expanded":
      return `hybrid A* after ${plural(frame.n_steps, "step")}`;
    case "improved":
      return `certified path of ${meters(frame.length_m)} after ${fixed(frame.at_ms, 1)} ms`;
  }
}

function recordWords(unit: string, record: IterationRecord): string {
  const best = record.best_so_far_cost;
  const cost = best === null ? "" : `, best cost ${fixed(best, 1)}`;
  return `${unit} ${count(record.iteration + 1)}: ${count(record.n_arrived)} of ${count(record.n_ants)} arrived${cost}`;
}
