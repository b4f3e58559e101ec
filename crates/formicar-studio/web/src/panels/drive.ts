/** Driving the path: which law, the clock, and how the wheels stand. */

import type { Actions } from "../actions";
import { RATES, type DriveClock } from "../drive_clock";
import { h, s, setText } from "../dom";
import { degrees, fixed, meters, plural, seconds } from "../format";
import { icon } from "../icons";
import type { DrivenMessage, DriveLaw, Slot } from "../protocol";
import { answerOf, shownSlot } from "../state";
import type { State, Store } from "../store";
import { durationS, pointAt } from "../trace";
import { SlotChoice } from "./slot";
import { button, iconButton, Segments, Select, section } from "./widgets";

const LAWS: readonly (readonly [DriveLaw, string])[] = [
  ["open-loop", "Open loop"],
  ["pure-pursuit", "Pure pursuit"],
  ["stanley", "Stanley"],
];

const ABOUT: Record<DriveLaw, string> = {
  "open-loop":
    "Applies the path's own steering angles at the driven length, without feedback.",
  "pure-pursuit": "Follows the circle to a point ahead on the path.",
  stanley: "Aligns the front wheels with the path and steers toward it.",
};

export function drivePanel(
  host: HTMLElement,
  store: Store,
  actions: Actions,
  clock: DriveClock,
): void {
  new Panel(host, store, actions, clock);
}

class Panel {
  private law: DriveLaw = "stanley";
  private readonly slots: SlotChoice;
  private readonly laws: Segments<DriveLaw>;
  private readonly about = h("p", { class: "about" });
  private readonly go: HTMLButtonElement;
  private readonly stop: HTMLButtonElement;
  private readonly run: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly time = h("output", { class: "time" });
  private readonly speed: Select<string>;
  private readonly wheels = new WheelGauge();
  private readonly now = h("dl", { class: "facts live" });
  private readonly outcome = h("p", { class: "outcome" });
  private readonly summary = h("dl", { class: "facts" });
  private readonly driving: HTMLElement;
  private shown: DrivenMessage | null = null;

  constructor(
    host: HTMLElement,
    private readonly store: Store,
    private readonly actions: Actions,
    private readonly clock: DriveClock,
  ) {
    this.slots = new SlotChoice(store);
    this.laws = new Segments("Control law", LAWS, (law) => this.choose(law));
    this.go = button("Drive", () => this.drive(), { icon: "wheel", class: "primary" });
    this.stop = button("Stop", () => actions.stopDriving(), { icon: "stop" });
    this.run = iconButton("play", "Play the drive", () => clock.toggle());
    this.slider = h("input", {
      type: "range",
      min: 0,
      max: 1,
      step: "any",
      "aria-label": "Time of the drive",
      oninput: () => this.seek(),
    });
    this.speed = new Select(
      RATES.map((rate) => [String(rate), `${rate} \u00d7`] as const),
      (rate) => clock.setRate(Number(rate)),
      "Playback speed",
    );
    this.driving = h(
      "div",
      { class: "driving" },
      h("div", { class: "transport" }, this.run, this.slider, this.time, this.speed.element),
      this.wheels.element,
      this.now,
      this.outcome,
      this.summary,
    );
    host.append(
      this.slots.element,
      section(
        "Control law",
        null,
        this.laws.element,
        this.about,
        h("div", { class: "buttons" }, this.go, this.stop),
      ),
      this.driving,
      h(
        "p",
        { class: "about hint" },
        "Paint an obstacle during the drive, and the vehicle replans from its current pose.",
      ),
    );
    store.watch(["slots", "shown", "driveS"], (state) => this.show(state));
    clock.onChange(() => this.showClock());
  }

  private get slot(): Slot {
    return this.store.state.shown;
  }

  private choose(law: DriveLaw): void {
    this.law = law;
    if (shownSlot(this.store.state).driven) this.drive();
    else this.show(this.store.state);
  }

  private drive(): void {
    this.clock.begin();
    this.actions.drive(this.slot, this.law);
  }

  private seek(): void {
    this.clock.pause();
    this.store.set({ driveS: Number(this.slider.value) });
  }

  private show(state: Readonly<State>): void {
    this.slots.show(state);
    const slot = shownSlot(state);
    const { driven } = slot;
    this.go.disabled = !answerOf(slot)?.path || state.vehicle?.motion === "point";
    this.stop.disabled = driven === null || state.driveS === null;
    this.laws.show(this.law);
    setText(this.about, ABOUT[this.law]);
    this.driving.hidden = driven === null;
    if (driven === null) return;
    if (driven !== this.shown) this.showOutcome(driven);
    this.showMoment(driven, state);
  }

  private showOutcome(driven: DrivenMessage): void {
    this.shown = driven;
    if (this.law !== driven.law) this.law = driven.law;
    this.laws.show(driven.law);
    this.slider.max = String(durationS(driven));
    this.outcome.dataset.kind = driven.tracked ? "good" : "bad";
    this.outcome.replaceChildren(icon(driven.tracked ? "check" : "alert"), outcomeOf(driven));
    this.summary.replaceChildren(...summaryOf(driven));
    this.showClock();
  }

  private showMoment(driven: DrivenMessage, state: Readonly<State>): void {
    const t = state.driveS ?? durationS(driven);
    const moment = pointAt(driven, t);
    if (moment === null) return;
    this.slider.value = String(t);
    setText(this.time, `${fixed(t, 1)} s`);
    this.wheels.show(moment.left_wheel_rad, moment.right_wheel_rad);
    show(this.now, [
      ["Left wheel", degrees(moment.left_wheel_rad)],
      ["Right wheel", degrees(moment.right_wheel_rad)],
      ["Cross-track error", meters(moment.cross_track_error_m)],
      ["Gear", moment.direction === 1 ? "forward" : "reverse"],
    ]);
  }

  private showClock(): void {
    const isOn = this.clock.isRunning;
    const label = isOn ? "Pause the drive" : "Play the drive";
    if (this.run.getAttribute("aria-label") !== label) {
      this.run.replaceChildren(icon(isOn ? "pause" : "play"));
      this.run.setAttribute("aria-label", label);
      this.run.title = label;
    }
    this.speed.show(String(this.clock.rate));
  }
}

/** Both front wheels from above, as they stand. */
class WheelGauge {
  readonly element: SVGSVGElement;
  private readonly wheels: SVGElement[];

  constructor() {
    const wheel = (x: number): SVGElement =>
      s("rect", { class: "wheel", x: x - 6, y: 22, width: 12, height: 36, rx: 3 });
    this.wheels = [wheel(90), wheel(190)];
    this.element = s(
      "svg",
      {
        class: "wheel-gauge",
        viewBox: "0 0 280 80",
        role: "img",
        "aria-label": "Front wheels, top view",
      },
      s("line", { class: "axle", x1: 90, y1: 40, x2: 190, y2: 40 }),
      s("line", { class: "ahead", x1: 90, y1: 8, x2: 90, y2: 72 }),
      s("line", { class: "ahead", x1: 190, y1: 8, x2: 190, y2: 72 }),
      ...this.wheels,
    );
  }

  show(left: number, right: number): void {
    [left, right].forEach((angle, i) => {
      const x = i === 0 ? 90 : 190;
      this.wheels[i]?.setAttribute("transform", `rotate(${fixedAngle(angle)} ${x} 40)`);
    });
  }
}

function fixedAngle(radians: number): string {
  return ((-radians * 180) / Math.PI).toFixed(2);
}

function outcomeOf({ tracked, contact, status }: DrivenMessage): string {
  if (contact)
    return `The vehicle touches an obstacle at (${fixed(contact.x, 2)}, ${fixed(contact.y, 2)}) m after ${seconds(contact.t_s)}`;
  return tracked
    ? "The vehicle arrives without contact"
    : `The vehicle does not arrive: ${status.replace(/[_-]/g, " ")}`;
}

function summaryOf({ summary, min_clearance_m }: DrivenMessage): HTMLElement[] {
  const changes = summary.n_gear_changes ?? 0;
  const facts: [string, string][] = [
    ["Driven", `${meters(summary.driven_m)} in ${seconds(summary.duration_s)}`],
    ["Greatest cross-track error", meters(summary.max_cross_track_error_m)],
    ["Goal error", `${meters(summary.goal_error_m)}, ${degrees(summary.goal_error_rad)}`],
    ["Least clearance", meters(min_clearance_m)],
    ["Greatest wheel angle", degrees(summary.max_wheel_rad)],
  ];
  if (changes > 0) facts.push(["Gear changes", plural(changes, "change")]);
  return facts.map(([term, value]) => h("div", {}, h("dt", {}, term), h("dd", {}, value)));
}

/** Sets terms and values of a list without building it anew. */
function show(list: HTMLElement, facts: readonly (readonly [string, string])[]): void {
  if (list.childElementCount !== facts.length) {
    list.replaceChildren(...facts.map(([term]) => h("div", {}, h("dt", {}, term), h("dd", {}))));
  }
  facts.forEach(([, value], i) => {
    const place = list.children[i]?.lastElementChild;
    if (place) setText(place, value);
  });
}
