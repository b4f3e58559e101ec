/** The state of the page in one place; views are notified of changes. */

import type {
  AnswerMessage,
  Catalog,
  Config,
  DriveFrame,
  DrivenMessage,
  ExpandedFrame,
  GenerationFrame,
  ImprovedFrame,
  IterationFrame,
  MapMessage,
  Request,
  Slot,
  VehicleMessage,
} from "./protocol";

/** A map with its values, row by row, lowest row first. */
export interface MapState extends MapMessage {
  values: Int8Array;
  /** Whether it was edited since it was opened. */
  isEdited: boolean;
  /** Grows with every change of the values. */
  version: number;
}

/** The frames of a run for playback, in order of arrival. */
export type Frame =
  | (IterationFrame & { pheromone: Uint8Array })
  | GenerationFrame
  | DriveFrame
  | ExpandedFrame
  | ImprovedFrame;

/** A plan, under way or ended. */
export interface PlanState {
  plan: number;
  request: Request;
  frames: Frame[];
  /** The best certified path so far. */
  improved: ImprovedFrame | null;
  /** Its end; null while it is under way. */
  end: AnswerMessage | null;
  /** When it was asked for, and when its first path was drawn, `performance.now()`. */
  askedAtMs: number;
}

/** One side of a comparison. */
export interface SlotState {
  config: Config;
  seed: number;
  plan: PlanState | null;
  driven: DrivenMessage | null;
  /** The vehicle waits at its pose while the rest of the path is replanned. */
  isHeld?: boolean;
}

/** The tools for the map. */
export type Tool = "move" | "paint" | "erase";

export interface State {
  catalog: Catalog | null;
  isConnected: boolean;
  map: MapState | null;
  vehicle: VehicleMessage | null;
  /** Start, goal and modes; both slots plan it. */
  request: Request;
  slots: { a: SlotState; b: SlotState | null };
  /** The slot that charts and playback show. */
  shown: Slot;
  tool: Tool;
  brushM: number;
  /** The position of playback, as an index into the frames of the shown plan; null: the end. */
  frame: number | null;
  /** The progress of playback within that frame, 0 to 1: ants walk meanwhile. */
  frameShare: number;
  isPlaying: boolean;
  /** The step that is shown; null: none. */
  step: number | null;
  /** Arc length that the charts or the map point at, meters along the shown path. */
  hoverM: number | null;
  /** Time of the drive that is shown, seconds; null: no drive. */
  driveS: number | null;
  /** The layers drawn over the map. */
  layers: { swept: boolean; pheromone: boolean; ants: boolean; clearance: boolean };
  /** Whether there is an edit to undo or to redo. */
  past: { canUndo: boolean; canRedo: boolean };
  /** The last error, which the page shows. */
  error: string | null;
}

export type Key = keyof State;
type Listener = (state: Readonly<State>) => void;

/** Holds the state; listeners are called once per animation frame, whatever has changed of what
 * they asked for. */
export class Store {
  private readonly listeners: { keys: readonly Key[]; call: Listener }[] = [];
  private changed = new Set<Key>();

  constructor(private readonly current: State) {}

  get state(): Readonly<State> {
    return this.current;
  }

  /** Changes some of the state. */
  set(part: Partial<State>): void {
    Object.assign(this.current, part);
    for (const key of Object.keys(part) as Key[]) this.touch(key);
  }

  /** Tells that something inside of a part has changed. */
  touch(key: Key): void {
    if (this.changed.size === 0) requestAnimationFrame(() => this.tell());
    this.changed.add(key);
  }

  /** Calls `call` now and whenever one of the parts has changed. */
  watch(keys: readonly Key[], call: Listener): void {
    this.listeners.push({ keys, call });
    call(this.current);
  }

  private tell(): void {
    const changed = this.changed;
    this.changed = new Set();
    for (const { keys, call } of this.listeners) {
      if (keys.some((key) => changed.has(key))) call(this.current);
    }
  }
}
