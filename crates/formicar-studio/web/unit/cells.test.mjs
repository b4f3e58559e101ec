/** Cells of a map: places, rectangles and remembered changes. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { bounds, changesSince, noteChange, regionsOf, rounded, toCells, toWorld, valuesIn } from "../src/cells.ts";

const grid = { n_cols: 40, n_rows: 30, resolution_m: 0.5, origin: [2, -1, Math.PI / 2] };
const mapOf = (n_cols, n_rows) => ({
  n_cols,
  n_rows,
  resolution_m: 1,
  origin: [0, 0, 0],
  values: Int8Array.from({ length: n_cols * n_rows }, (_, i) => i % 100),
  version: 0,
  isEdited: false,
});
const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-9, `${a} is not ${b}`));

test("cells and world are inverse, in a turned frame too", () => {
  near(toWorld(grid, 2, 4), [0, 0]);
  near(toCells(grid, ...toWorld(grid, 7.5, 3.25)), [7.5, 3.25]);
  const { low, high } = bounds(grid);
  near(low, [-13, -1]);
  near(high, [2, 19]);
});

test("rectangles hold all cells, in bands of rows", () => {
  const cells = [0, 41, 3 * 40 + 39, 17 * 40 + 5];
  const regions = regionsOf(cells, 40);
  assert.deepEqual(regions, [
    { col: 0, row: 0, n_cols: 40, n_rows: 4 },
    { col: 5, row: 17, n_cols: 1, n_rows: 1 },
  ]);
  assert.deepEqual(valuesIn(mapOf(5, 5), { col: 1, row: 2, n_cols: 2, n_rows: 2 }), [11, 12, 16, 17]);
});

test("changes are remembered since any version, until there are too many", () => {
  const map = mapOf(5, 5);
  const one = { col: 0, row: 0, n_cols: 1, n_rows: 1 };
  noteChange(map, [one]);
  noteChange(map, [one, one]);
  assert.equal(map.version, 2);
  assert.equal(map.isEdited, true);
  assert.equal(changesSince(map, 0).length, 3);
  assert.equal(changesSince(map, 1).length, 2);
  assert.deepEqual(changesSince(map, 2), []);
  for (let i = 0; i < 300; i += 1) noteChange(map, [one]);
  assert.equal(changesSince(map, 2), null);
  assert.equal(changesSince(map, 301).length, 1);
});

test("a pose is rounded, its heading within a turn", () => {
  near(rounded([1.23456, -2.00004, 3 * Math.PI]), [1.2346, -2, 3.1416]);
});
