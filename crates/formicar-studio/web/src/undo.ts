/** What was done, to be undone and done again. */

import type { Request } from "./protocol";

/** A change of cells, or of the request. */
export type Deed =
  | { kind: "stroke"; cells: Int32Array; before: Int8Array; after: Int8Array }
  | { kind: "request"; before: Request; after: Request };

const MAX_DEEDS = 200;
/** All strokes together hold at most so many cells. */
const MAX_CELLS = 1 << 24;

export class Past {
  private done: Deed[] = [];
  private undone: Deed[] = [];

  /** `changed` hears of every change. */
  constructor(private readonly changed: (past: { canUndo: boolean; canRedo: boolean }) => void) {}

  /** Keeps what was done; what was undone before it is gone. */
  push(deed: Deed): void {
    this.done.push(deed);
    this.undone = [];
    while (this.done.length > MAX_DEEDS || nCells(this.done) > MAX_CELLS) this.done.shift();
    this.tell();
  }

  /** The deed to take back, or null. */
  undo(): Deed | null {
    return this.shift(this.done, this.undone);
  }

  /** The deed to do again, or null. */
  redo(): Deed | null {
    return this.shift(this.undone, this.done);
  }

  clear(): void {
    this.done = [];
    this.undone = [];
    this.tell();
  }

  private shift(from: Deed[], to: Deed[]): Deed | null {
    const deed = from.pop() ?? null;
    if (deed !== null) to.push(deed);
    this.tell();
    return deed;
  }

  private tell(): void {
    this.changed({ canUndo: this.done.length > 0, canRedo: this.undone.length > 0 });
  }
}

function nCells(deeds: readonly Deed[]): number {
  return deeds.reduce((n, deed) => n + (deed.kind === "stroke" ? deed.cells.length : 0), 0);
}
