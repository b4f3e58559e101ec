/** Strokes of the brush: what is kept for undo and what is sent. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Strokes } from "../src/strokes.ts";

function setting(n_cols = 6, n_rows = 4) {
  const map = { n_cols, n_rows, values: new Int8Array(n_cols * n_rows), version: 0, isEdited: false };
  const sent = [];
  const store = { state: { map }, touch: () => {} };
  const strokes = new Strokes(store, { send: (message) => sent.push(message) });
  return { map, sent, store, strokes };
}

test("a stroke keeps each cell once, as it was before", () => {
  const { map, sent, strokes } = setting();
  map.values[1] = 40;
  assert.equal(strokes.paint([1, 2], 100), true);
  assert.equal(strokes.paint([2, 1, 3], 100), true);
  assert.equal(strokes.paint([3], 100), false);
  const deed = strokes.end();
  assert.deepEqual([...deed.cells], [1, 2, 3]);
  assert.deepEqual([...deed.before], [40, 0, 0]);
  assert.deepEqual([...deed.after], [100, 100, 100]);
  assert.equal(strokes.end(), null);
  assert.deepEqual(sent[0], {
    type: "paint",
    region: { col: 1, row: 0, n_cols: 2, n_rows: 1 },
    values: [100, 100],
  });
});

test("putting back sends the old values", () => {
  const { map, sent, strokes } = setting();
  strokes.paint([7, 8], 100);
  const deed = strokes.end();
  strokes.put(deed.cells, deed.before);
  assert.ok(map.values.every((value) => value === 0));
  assert.deepEqual(sent.at(-1).values, [0, 0]);
});

test("cells off the map and a map that is absent change nothing", () => {
  const { store, strokes } = setting();
  assert.equal(strokes.paint([1000], 100), false);
  store.state.map = null;
  assert.equal(strokes.paint([1], 100), false);
  assert.equal(strokes.end(), null);
});

test("a large map is sent in bands that hold every cell once", () => {
  const { map, sent, strokes } = setting(1024, 700);
  strokes.sendAll(map);
  const rows = sent.map(({ region }) => [region.row, region.n_rows]);
  assert.deepEqual(rows, [[0, 256], [256, 256], [512, 188]]);
});
