/** The drive that is shown, and replanning on the way when the ground changes under it. */

import type { Connection } from "./connection";
import type { AnswerMessage, DriveLaw, DrivenMessage, Pose, Request, Slot } from "./protocol";
import type { Store } from "./store";
import { durationS, indexAt, pointAt, poseOf } from "./trace";

export class Driving {
  private law: DriveLaw = "open-loop";
  /** When the vehicle stood where a plan starts, by the start pose of that plan. */
  private readonly departures = new WeakMap<Pose, number>();

  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
  ) {}

  start(slot: Slot, law: DriveLaw): void {
    this.law = law;
    this.connection.send({ type: "drive", slot, law });
  }

  stop(slot: Slot): void {
    const { slots, driveS } = this.store.state;
    const side = slots[slot];
    if (side === null || side.driven === null) return;
    side.driven = null;
    side.isHeld = false;
    this.store.touch("slots");
    if (driveS !== null) this.store.set({ driveS: null });
  }

  /** The request from where the vehicle is now, which waits for it; null where none is on its way. */
  onTheWay(slot: Slot, request: Request): Request | null {
    const { slots, driveS } = this.store.state;
    const side = slots[slot];
    const driven = side?.driven;
    if (!driven || driveS === null || driveS >= durationS(driven)) return null;
    const point = pointAt(driven, driveS);
    if (point === null) return null;
    const start = poseOf(point);
    this.departures.set(start, driveS);
    side.isHeld = true;
    return { ...request, start };
  }

  /** Whether a plan was ordered during the drive. */
  isOnTheWay(request: Request): boolean {
    return this.departures.has(request.start);
  }

  /** The path from here on: the vehicle drives it, or stops if there is none. */
  replanned(slot: Slot, message: AnswerMessage): void {
    if (message.answer.path) this.start(slot, this.law);
    else this.halt(slot);
  }

  /** A drive failed: its waiter goes on. */
  failed(): void {
    const { a, b } = this.store.state.slots;
    for (const side of [a, b]) if (side !== null) side.isHeld = false;
  }

  /** A drive came: it begins, or goes on from where the vehicle has come to meanwhile. */
  driven(message: DrivenMessage): void {
    const { slots, driveS } = this.store.state;
    const side = slots[message.slot];
    if (side === null || side.plan?.plan !== message.plan) return;
    const departureS = this.departures.get(side.plan.request.start);
    const isGoingOn = departureS !== undefined && side.driven !== null && driveS !== null;
    const passedS = isGoingOn ? Math.max(0, driveS - departureS) : 0;
    side.driven = message;
    side.isHeld = false;
    this.store.touch("slots");
    this.store.set({ driveS: Math.min(passedS, durationS(message)) });
  }

  private halt(slot: Slot): void {
    const { slots, driveS } = this.store.state;
    const side = slots[slot];
    if (side === null || side.driven === null || driveS === null) return;
    const trace = side.driven.trace.slice(0, indexAt(side.driven.trace, driveS) + 1);
    side.driven = { ...side.driven, tracked: false, status: "stopped: no way on", trace };
    side.isHeld = false;
    this.store.touch("slots");
    this.store.set({ driveS: trace.at(-1)?.t_s ?? 0 });
  }
}
