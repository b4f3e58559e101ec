/** Obstacles painted and erased, stroke by stroke. */

import { noteChange, regionsOf, valuesIn } from "./cells";
import type { Connection } from "./connection";
import type { MapState, Store } from "./store";
import type { Edit } from "./undo";

type StrokeEdit = Extract<Edit, { kind: "stroke" }>;

export class Strokes {
  /** Values before the stroke under way, by cell. */
  private before = new Map<number, number>();

  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
  ) {}

  /** Goes on with a stroke; whether any cell has changed. */
  paint(cells: Iterable<number>, value: number): boolean {
    const { map } = this.store.state;
    if (map === null) return false;
    const changed: number[] = [];
    for (const cell of cells) {
      const old = map.values[cell];
      if (old === undefined || old === value) continue;
      if (!this.before.has(cell)) this.before.set(cell, old);
      map.values[cell] = value;
      changed.push(cell);
    }
    if (changed.length === 0) return false;
    this.send(map, changed);
    return true;
  }

  /** Ends the stroke; null if it changed nothing. */
  end(): StrokeEdit | null {
    const { map } = this.store.state;
    const { before } = this;
    this.before = new Map();
    if (map === null || before.size === 0) return null;
    const cells = Int32Array.from(before.keys());
    const after = Int8Array.from(cells, (cell) => map.values[cell] ?? 0);
    return { kind: "stroke", cells, before: Int8Array.from(before.values()), after };
  }

  /** Puts the values of a stroke's cells. */
  put(cells: Int32Array, values: Int8Array): void {
    const { map } = this.store.state;
    if (map === null) return;
    cells.forEach((cell, i) => {
      map.values[cell] = values[i] ?? 0;
    });
    this.send(map, cells);
  }

  /** Sends the whole map, to a server that has it as it was opened. */
  sendAll(map: MapState): void {
    const { n_cols, n_rows } = map;
    const bandRows = Math.max(1, Math.floor((1 << 18) / n_cols));
    for (let row = 0; row < n_rows; row += bandRows) {
      const region = { col: 0, row, n_cols, n_rows: Math.min(bandRows, n_rows - row) };
      this.connection.send({ type: "paint", region, values: valuesIn(map, region) });
    }
  }

  private send(map: MapState, cells: Iterable<number>): void {
    const regions = regionsOf(cells, map.n_cols);
    for (const region of regions) {
      this.connection.send({ type: "paint", region, values: valuesIn(map, region) });
    }
    noteChange(map, regions);
    this.store.touch("map");
  }
}
