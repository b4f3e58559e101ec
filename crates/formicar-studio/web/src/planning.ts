/** Orders of plans and their answers: one under way in each slot, the newest wish next. */

import type { Connection } from "./connection";
import type { AnswerMessage, ImprovedFrame, Request, Slot } from "./protocol";
import { FrameBuffer } from "./frame_buffer";
import { stats } from "./stats";
import type { Frame, PlanState, SlotState, Store } from "./store";

/** A plan that somebody wants. */
export interface Wish {
  request: Request;
  /** `follow`: something is being dragged, and the path goes along. `settle`: it was let go.
   * `replay`: the run is to be seen from its beginning. */
  manner: "follow" | "settle" | "replay";
  /** The request starts where the vehicle drives: the plan goes along its path as far as it can. */
  isOnTheWay?: boolean;
  /** When it was wished for, `performance.now()`. */
  atMs: number;
}

/** The plan under way in a slot, and what waits for it. */
interface Line {
  flight: Flight | null;
  next: Wish | null;
  /** The last plan, if it was answered with a path: it can be replanned along. */
  found: number | null;
}

interface Flight {
  plan: PlanState;
  wish: Wish;
  buffer: FrameBuffer;
  /** Whether a path or the answer has arrived. */
  hasNews: boolean;
  isShown: boolean;
}

/** A new plan takes the place of the old one after so long even if nothing of it has come. */
const PATIENCE_MS = 300;

export class Planning {
  private nPlans = 0;
  private readonly lines: Record<Slot, Line> = { a: idle(), b: idle() };

  /** `answered` is called with every answer that is not outdated. */
  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
    private readonly answered: (message: AnswerMessage) => void,
  ) {}

  ask(slot: Slot, wish: Wish): void {
    const line = this.lines[slot];
    const mayWait = wish.manner === "follow" || wish.isOnTheWay === true;
    if (mayWait && line.flight !== null && !isReady(wish, line.flight)) line.next = wish;
    else this.send(slot, wish);
  }

  /** Stops what is under way. */
  cancel(slot: Slot): void {
    this.lines[slot].next = null;
    this.connection.send({ type: "cancel", slot });
  }

  /** Clears a slot after a change of the map or a lost connection. */
  forget(slot: Slot): void {
    Object.assign(this.lines[slot], idle());
  }

  frame(frame: Exclude<Frame, ImprovedFrame>): void {
    const flight = this.flightOf(frame.plan)?.flight;
    if (!flight) return;
    this.keep(flight, frame);
    this.store.touch("slots");
  }

  improved(frame: ImprovedFrame): void {
    const line = this.flightOf(frame.plan);
    if (!line?.flight) return;
    line.flight.plan.improved = frame;
    this.keep(line.flight, frame);
    this.news(frame.slot, line.flight);
  }

  answer(message: AnswerMessage): void {
    const line = this.flightOf(message.plan);
    if (!line?.flight) return;
    const { flight } = line;
    flight.plan.end = message;
    line.flight = null;
    line.found = message.answer.path ? message.plan : null;
    this.news(message.slot, flight);
    // Where the next plan has gone off already, its answer counts.
    if (!this.isUnderWay(message.slot)) this.answered(message);
  }

  private isUnderWay(slot: Slot): boolean {
    return this.lines[slot].flight !== null;
  }

  /** A plan could not even be begun: that is its answer. Whether it is the one under way. */
  refused(plan: number, reason: string): boolean {
    for (const slot of ["a", "b"] as const) {
      const side = this.store.state.slots[slot];
      if (side === null || this.lines[slot].flight?.plan.plan !== plan) continue;
      this.answer(refusal(plan, slot, side, reason));
      return true;
    }
    return false;
  }

  private send(slot: Slot, wish: Wish): void {
    const side = this.store.state.slots[slot];
    if (side === null) return;
    const line = this.lines[slot];
    const previous = wish.isOnTheWay ? line.found : null;
    line.next = null;
    line.found = null;
    this.nPlans += 1;
    const isSent = this.connection.send({
      type: "plan",
      plan: this.nPlans,
      slot,
      request: wish.request,
      config: side.config,
      seed: side.seed,
      watch: wish.manner !== "follow",
      ...(previous === null ? {} : { previous }),
    });
    if (!isSent) return;
    const plan = newPlan(this.nPlans, wish);
    const buffer = new FrameBuffer(plan.frames);
    const flight: Flight = { plan, wish, buffer, hasNews: false, isShown: false };
    line.flight = flight;
    if (wish.manner !== "replay") stats.asked(plan.plan, wish.atMs);
    if (wish.manner === "replay") this.show(slot, flight);
    if (wish.manner === "settle") setTimeout(() => this.show(slot, flight), PATIENCE_MS);
  }

  /** A path or an answer came: it is shown, and the next plan may go. */
  private news(slot: Slot, flight: Flight): void {
    flight.hasNews = true;
    this.show(slot, flight);
    this.store.touch("slots");
    const { next } = this.lines[slot];
    if (next !== null && isReady(next, flight)) this.send(slot, next);
  }

  private show(slot: Slot, flight: Flight): void {
    const side = this.store.state.slots[slot];
    // Whoever was overtaken before anything came is never shown.
    const isOvertaken = !flight.hasNews && this.lines[slot].flight !== flight;
    if (flight.isShown || side === null || isOvertaken) return;
    flight.isShown = true;
    side.plan = flight.plan;
    this.store.touch("slots");
    if (slot !== this.store.state.shown) return;
    const isReplayed = flight.wish.manner === "replay";
    this.store.set({ frame: isReplayed ? 0 : null, frameShare: 0, isPlaying: isReplayed });
  }

  private keep(flight: Flight, frame: Frame): void {
    const { store } = this;
    const frames = flight.plan.frames;
    const isWatched = store.state.slots[store.state.shown]?.plan === flight.plan;
    const shownFrame = isWatched ? frames[store.state.frame ?? -1] : undefined;
    flight.buffer.push(frame);
    if (shownFrame === undefined || frames[store.state.frame ?? -1] === shownFrame) return;
    // The frames were thinned: playback stays with the one it shows, or near it.
    const at = frames.indexOf(shownFrame);
    const near = Math.min(store.state.frame ?? 0, frames.length - 1) >> 1;
    store.set({ frame: at >= 0 ? at : near });
  }

  private flightOf(plan: number): Line | undefined {
    return Object.values(this.lines).find((line) => line.flight?.plan.plan === plan);
  }
}

/** Whether a wish may overtake a plan: what is dragged as soon as there is a path; what replans on
 * the way only after the answer, for it goes along that path. */
function isReady(wish: Wish, flight: Flight): boolean {
  return wish.isOnTheWay ? flight.plan.end !== null : flight.hasNews;
}

/** The answer to a plan that the server would not begin. */
function refusal(plan: number, slot: Slot, side: SlotState, reason: string): AnswerMessage {
  const answer: AnswerMessage["answer"] = {
    schema: "formicar/answer/1",
    status: "invalid_request",
    code: "UNKNOWN",
    code_number: 200,
    reason,
    planner: side.config.planner,
    seed: side.seed,
    timing: { map_setup_s: 0, first_feasible_s: null, query_s: 0, total_s: 0 },
    provenance: {},
  };
  return {
    type: "answer",
    plan,
    slot,
    answer,
    history: [],
    stages: {},
    tightest: null,
    cli: "",
    toml: "",
  };
}

function idle(): Line {
  return { flight: null, next: null, found: null };
}

function newPlan(plan: number, wish: Wish): PlanState {
  const { request, atMs } = wish;
  return { plan, request, frames: [], improved: null, end: null, askedAtMs: atMs };
}
