/** The history of edits, for undo and redo. */

import type { Request } from "./protocol";

/** A change of cells, or of the request. */
export type Edit =
  | { kind: "stroke"; cells: Int32Array; before: Int8Array; after: Int8Array }
  | { kind: "request"; before: Request; after: Request };

const MAX_EDITS = 200;
/** The most cells of all strokes together. */
const MAX_CELLS = 1 << 24;

export class Past {
  private done: Edit[] = [];
  private undone: Edit[] = [];

  /** `changed` is called after every change. */
  constructor(private readonly changed: (past: { canUndo: boolean; canRedo: boolean }) => void) {}

  /** Adds an edit; undone edits are dropped. */
  push(edit: Edit): void {
    this.done.push(edit);
    this.undone = [];
    while (this.done.length > MAX_EDITS || nCells(this.done) > MAX_CELLS) this.done.shift();
    this.notify();
  }

  /** The edit to undo, or null. */
  undo(): Edit | null {
    return this.shift(this.done, this.undone);
  }

  /** The edit to redo, or null. */
  redo(): Edit | null {
    return this.shift(this.undone, this.done);
  }

  clear(): void {
    this.done = [];
    this.undone = [];
    this.notify();
  }

  private shift(from: Edit[], to: Edit[]): Edit | null {
    const edit = from.pop() ?? null;
    if (edit !== null) to.push(edit);
    this.notify();
    return edit;
  }

  private notify(): void {
    this.changed({ canUndo: this.done.length > 0, canRedo: this.undone.length > 0 });
  }
}

function nCells(edits: readonly Edit[]): number {
  return edits.reduce((n, edit) => n + (edit.kind === "stroke" ? edit.cells.length : 0), 0);
}
