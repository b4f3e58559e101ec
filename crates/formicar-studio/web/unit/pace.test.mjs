/** The pace at which a run is shown. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { durationMs } from "../src/pace.ts";

const frames = (...types) => types.map((type) => ({ type }));
const total = (list, isLive) => list.reduce((sum, _, i) => sum + durationMs(list, i, isLive), 0);

test("a short run is shown at its own pace", () => {
  const run = frames("expanded", "expanded", "improved");
  assert.deepEqual(run.map((_, i) => durationMs(run, i, false)), [70, 70, 300]);
  assert.equal(durationMs(run, 3, false), 0);
});

test("a long run fits its budget, before and after the first path", () => {
  const search = Array(400).fill("expanded");
  const improvement = Array(100).fill("improved");
  const run = frames(...search, ...improvement);
  assert.ok(Math.abs(total(run, true) - 3200) < 1e-6);
  assert.ok(Math.abs(total(run, false) - 18_000) < 1e-6);
});

test("a live colony has more time than a live search", () => {
  const colony = frames(...Array(500).fill("iteration"));
  assert.ok(Math.abs(total(colony, true) - 6000) < 1e-6);
});
