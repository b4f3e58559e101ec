/** Curvature, steering and clearance over the length of the path, with their limits. */

import { h } from "../dom";
import { degrees, fixed, meters } from "../format";
import type { Answer, PoseRecord } from "../protocol";
import { answerOf, posesOf, shownSlot } from "../state";
import type { State, Store } from "../store";
import { pointAt } from "../trace";
import { QUANTITIES, Strip } from "./strip";

/** While the path follows a dragged pose, charts are drawn so often at most. */
const CALM_MS = 100;
const KEY_STEPS = 200;

export function showStrips(host: HTMLElement, store: Store): void {
  new Strips(host, store);
}

class Strips {
  private readonly strips: Strip[];
  private readonly element: HTMLElement;
  private readonly empty = h(
    "p",
    { class: "empty" },
    "There is no path to draw a profile of.",
  );
  private poses: PoseRecord[] = [];
  private timer = 0;

  constructor(
    host: HTMLElement,
    private readonly store: Store,
  ) {
    const point = (at: number | null): void =>
      store.set({ hoverM: at === null ? null : this.within(at) });
    this.strips = QUANTITIES.map(
      (quantity, i) => new Strip(quantity, i === QUANTITIES.length - 1, point),
    );
    this.element = h(
      "div",
      {
        class: "strips",
        tabindex: 0,
        role: "slider",
        "aria-label": "Position along the path",
        "aria-orientation": "horizontal",
        onkeydown: (event: KeyboardEvent) => this.key(event),
      },
      ...this.strips.map(({ element }) => element),
    );
    host.append(this.element, this.empty);
    store.watch(["slots", "shown", "vehicle"], () => this.soon());
    store.watch(["hoverM"], ({ hoverM }) => this.hover(hoverM));
    store.watch(["driveS", "slots", "shown"], (state) => this.drive(state));
  }

  private soon(): void {
    if (this.timer !== 0) return;
    const isFirst = this.poses.length === 0;
    this.timer = window.setTimeout(() => this.show(this.store.state), isFirst ? 0 : CALM_MS);
  }

  private show(state: Readonly<State>): void {
    this.timer = 0;
    const slot = shownSlot(state);
    // While another path is on its way the last one stays.
    if (answerOf(slot) === null && slot.plan !== null) return;
    const poses = posesOf(slot);
    this.element.hidden = poses.length === 0;
    this.empty.hidden = poses.length > 0;
    if (poses === this.poses) return;
    this.poses = poses;
    const drawn = withTightest(poses, answerOf(slot));
    for (const strip of this.strips) strip.show(drawn, state.vehicle);
    this.element.setAttribute("aria-valuemin", "0");
    this.element.setAttribute("aria-valuemax", fixed(this.length, 2));
  }

  private get length(): number {
    return this.poses[this.poses.length - 1]?.s ?? 0;
  }

  private within(at: number): number {
    return Math.min(Math.max(0, at), this.length);
  }

  private hover(hoverM: number | null): void {
    const pose = hoverM === null ? null : poseNear(this.poses, hoverM);
    for (const strip of this.strips) strip.hover(hoverM, pose);
    this.element.setAttribute("aria-valuenow", fixed(hoverM ?? 0, 2));
    this.element.setAttribute("aria-valuetext", pose === null ? "none" : inWords(pose));
  }

  private drive(state: Readonly<State>): void {
    const { driven } = shownSlot(state);
    const moment = driven && state.driveS !== null ? pointAt(driven, state.driveS) : null;
    for (const strip of this.strips) strip.plot.mark("car", moment?.s_m ?? null);
  }

  private key(event: KeyboardEvent): void {
    const steps: Record<string, number> = {
      ArrowLeft: -1,
      ArrowRight: 1,
      PageDown: -10,
      PageUp: 10,
    };
    const ends: Record<string, number> = { Home: 0, End: this.length };
    const step = steps[event.key];
    const to =
      step === undefined
        ? ends[event.key]
        : (this.store.state.hoverM ?? 0) + (step * this.length) / KEY_STEPS;
    if (event.key === "Escape") this.store.set({ hoverM: null });
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.store.set({ hoverM: this.within(to) });
  }
}

/** The pose nearest to a place along the path. */
function poseNear(poses: readonly PoseRecord[], at: number): PoseRecord | null {
  let [low, high] = [0, poses.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((poses[middle]?.s ?? 0) < at) low = middle + 1;
    else high = middle;
  }
  const [before, after] = [poses[low - 1], poses[low]];
  if (!before || !after) return after ?? null;
  return at - before.s < after.s - at ? before : after;
}

function inWords({ s, curvature, steer, clearance }: PoseRecord): string {
  return `${meters(s)}: curvature ${fixed(curvature, 3)} per meter, steering ${degrees(steer)}, clearance ${meters(clearance)}`;
}

/** The sampled poses, and between them the tightest place as the judge found it. */
function withTightest(poses: PoseRecord[], answer: Answer | null): PoseRecord[] {
  const { tightest_s_m: s, min_clearance_m: clearance } = answer?.certificate ?? {};
  if (typeof s !== "number" || typeof clearance !== "number") return poses;
  const next = poses.findIndex((pose) => pose.s >= s);
  const pose = poses[next];
  if (pose === undefined) return poses;
  return poses.toSpliced(next, 0, { ...pose, s, clearance });
}
