/** The clock of a drive: it moves `driveS`, as fast as the drive is to be seen. */

import { shownSlot } from "./state";
import type { Store } from "./store";
import type { DrivenMessage } from "./protocol";
import { durationS } from "./trace";

export const RATES = [1, 2, 5, 10, 20, 50] as const;

/** A drive is shown in about so long, however long it takes. */
const SHOWN_S = 20;
/** Longer pauses between two frames (a hidden page) are not driven through. */
const LONGEST_STEP_S = 0.1;

export class DriveClock {
  isRunning = false;
  rate = 1;
  private driven: DrivenMessage | null = null;
  private isAwaited = false;
  private lastMs = 0;
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly store: Store) {
    store.watch(["slots", "shown"], (state) => this.see(shownSlot(state).driven));
  }

  onChange(call: () => void): void {
    this.listeners.push(call);
  }

  /** A drive was asked for: it begins when it comes. */
  begin(): void {
    this.isAwaited = true;
  }

  toggle(): void {
    if (this.isRunning) this.pause();
    else this.run();
  }

  pause(): void {
    this.isRunning = false;
    this.tell();
  }

  setRate(rate: number): void {
    this.rate = rate;
    this.tell();
  }

  private see(driven: DrivenMessage | null): void {
    if (driven === this.driven) return;
    this.driven = driven;
    if (driven === null) this.pause();
    else if (this.isAwaited) this.start(driven);
  }

  private start(driven: DrivenMessage): void {
    this.isAwaited = false;
    const wanted = durationS(driven) / SHOWN_S;
    this.rate = RATES.find((rate) => rate >= wanted) ?? RATES[RATES.length - 1] ?? 1;
    const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (isCalm) this.pause();
    else this.run();
  }

  private run(): void {
    const { driveS } = this.store.state;
    if (this.driven === null) return;
    if (driveS === null || driveS >= durationS(this.driven)) this.store.set({ driveS: 0 });
    const wasRunning = this.isRunning;
    this.isRunning = true;
    this.lastMs = performance.now();
    this.tell();
    if (!wasRunning) requestAnimationFrame((ms) => this.tick(ms));
  }

  private tick(ms: number): void {
    const { driven, isHeld } = shownSlot(this.store.state);
    if (!this.isRunning) return;
    if (driven === null) {
      this.pause();
      return;
    }
    const stepS = isHeld === true ? 0 : Math.min(Math.max(0, (ms - this.lastMs) / 1000), LONGEST_STEP_S);
    this.lastMs = ms;
    const end = durationS(driven);
    const next = Math.min((this.store.state.driveS ?? 0) + stepS * this.rate, end);
    this.store.set({ driveS: next });
    if (next >= end) this.pause();
    else requestAnimationFrame((then) => this.tick(then));
  }

  private tell(): void {
    for (const call of this.listeners) call();
  }
}
