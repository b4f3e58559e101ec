/** Undo and redo. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Past } from "../src/undo.ts";

const request = (n) => ({ kind: "request", before: { n }, after: { n: n + 1 } });

function past() {
  const seen = [];
  return { past: new Past((state) => seen.push(state)), seen };
}

test("what was done is undone and done again in order", () => {
  const { past: all, seen } = past();
  all.push(request(1));
  all.push(request(2));
  assert.deepEqual(all.undo(), request(2));
  assert.deepEqual(all.undo(), request(1));
  assert.equal(all.undo(), null);
  assert.deepEqual(all.redo(), request(1));
  assert.deepEqual(seen.at(-1), { canUndo: true, canRedo: true });
});

test("something new forgets what was undone", () => {
  const { past: all, seen } = past();
  all.push(request(1));
  all.undo();
  all.push(request(5));
  assert.equal(all.redo(), null);
  assert.deepEqual(seen.at(-1), { canUndo: true, canRedo: false });
  all.clear();
  assert.equal(all.undo(), null);
});

test("the history is bounded in steps and in cells", () => {
  const { past: many } = past();
  for (let n = 0; n < 300; n += 1) many.push(request(n));
  let nUndone = 0;
  while (many.undo() !== null) nUndone += 1;
  assert.equal(nUndone, 200);

  const { past: large } = past();
  const stroke = () => ({ kind: "stroke", cells: { length: 10_000_000 }, before: null, after: null });
  large.push(stroke());
  large.push(stroke());
  assert.notEqual(large.undo(), null);
  assert.equal(large.undo(), null);
});
