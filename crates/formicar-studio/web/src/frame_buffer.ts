/** The frames of a run, kept for playback; too many are thinned evenly. */

import type { Frame } from "./store";

const MAX_FRAMES = 200;
const MAX_PHEROMONE_BYTES = 64 << 20;
/** Numbers of all expanded motions together, four to a motion. */
const MAX_MOTION_NUMBERS = 1 << 21;

/** Fills a list of frames that stays bounded. The newest of each kind is always there; paths are
 * few and are all kept, and motions are passed on to the frame that stays. */
export class FrameBuffer {
  private stride = 1;
  private readonly nSeen: Partial<Record<Frame["type"], number>> = {};
  /** Places of the frames among those of their kind. */
  private readonly places = new Map<Frame, number>();
  private nMotionNumbers = 0;

  constructor(private readonly frames: Frame[]) {}

  push(frame: Frame): void {
    const place = this.nSeen[frame.type] ?? 0;
    this.nSeen[frame.type] = place + 1;
    this.replaceLast(frame);
    this.places.set(frame, place);
    this.frames.push(frame);
    if (frame.type === "expanded") this.boundMotions(frame);
    const isFull = () => this.frames.length > MAX_FRAMES || this.isHeavy();
    while (isFull() && this.thin());
  }

  /** Lets go of the last frame of the same kind if it stood there only for want of a newer. */
  private replaceLast(frame: Frame): void {
    const index = this.frames.findLastIndex((other) => other.type === frame.type);
    const last = this.frames[index];
    if (last === undefined || this.isKept(last)) return;
    if (last.type === "expanded" && frame.type === "expanded") prepend(last.motions, frame);
    this.frames.splice(index, 1);
    this.places.delete(last);
  }

  private isKept(frame: Frame): boolean {
    return frame.type === "improved" || (this.places.get(frame) ?? 0) % this.stride === 0;
  }

  private isHeavy(): boolean {
    const bytes = (frame: Frame) => (frame.type === "iteration" ? frame.pheromone.length : 0);
    const nWithPheromone = this.frames.filter((frame) => bytes(frame) > 0).length;
    const total = this.frames.reduce((sum, frame) => sum + bytes(frame), 0);
    return nWithPheromone > 2 && total > MAX_PHEROMONE_BYTES;
  }

  /** Doubles the stride; false if nothing is left to thin. */
  private thin(): boolean {
    if (this.frames.every((frame) => frame.type === "improved")) return false;
    if (this.stride > 1 << 30) return false;
    this.stride *= 2;
    const newest = new Map(this.frames.map((frame) => [frame.type, frame]));
    let passedOn: number[] = [];
    const kept = this.frames.filter((frame) => {
      const stays = this.isKept(frame) || newest.get(frame.type) === frame;
      if (frame.type === "expanded" && stays) {
        if (passedOn.length > 0) prepend(passedOn, frame);
        passedOn = [];
      } else if (frame.type === "expanded") {
        passedOn = passedOn.concat(frame.motions);
      }
      if (!stays) this.places.delete(frame);
      return stays;
    });
    this.frames.splice(0, this.frames.length, ...kept);
    return true;
  }

  /** Drops every other motion if there are too many to draw. */
  private boundMotions(newest: { motions: number[] }): void {
    this.nMotionNumbers += newest.motions.length;
    if (this.nMotionNumbers <= MAX_MOTION_NUMBERS) return;
    this.nMotionNumbers = 0;
    for (const frame of this.frames) {
      if (frame.type !== "expanded") continue;
      frame.motions = frame.motions.filter((_, i) => (i >> 2) % 2 === 0);
      this.nMotionNumbers += frame.motions.length;
    }
  }
}

function prepend(motions: readonly number[], frame: { motions: number[] }): void {
  frame.motions = motions.concat(frame.motions);
}
