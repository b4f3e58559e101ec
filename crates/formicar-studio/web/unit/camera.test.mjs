/** The camera of the map. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Camera, View } from "../src/map/camera.ts";

const grid = { n_cols: 200, n_rows: 100, resolution_m: 0.1, origin: [0, 0, 0] };
const near = (a, b) => a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-9, `${a} is not ${b}`));

function fitted() {
  const camera = new Camera();
  camera.fit(grid, 1000, 800);
  return { camera, view: new View(camera, 1000, 800) };
}

test("a fitted map is seen whole", () => {
  const { camera, view } = fitted();
  assert.equal(camera.isFitted, true);
  for (const corner of [[0, 0], [20, 0], [20, 10], [0, 10]]) assert.ok(view.shows(...corner));
  assert.equal(view.shows(-5, 0), false);
});

test("pixels and places are inverse", () => {
  const { view } = fitted();
  near(view.toWorld(view.toPx(3.5, 7.25)), [3.5, 7.25]);
});

test("zooming keeps the place under the pointer and has limits", () => {
  const { camera, view } = fitted();
  const before = view.toPx(4, 2);
  camera.zoom(1.7, [4, 2]);
  near(view.toPx(4, 2), before);
  camera.zoom(1e9, [4, 2]);
  assert.equal(camera.pxPerM, 1200);
  near(view.toPx(4, 2), before);
});

test("panning moves the world with the pointer", () => {
  const { camera, view } = fitted();
  const [x, y] = view.toPx(4, 2);
  camera.pan(30, -20);
  near(view.toPx(4, 2), [x + 30, y - 20]);
  assert.equal(camera.isFitted, false);
});
