/** Paths and drives as the map draws them. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { clearanceAt, nearestOn, poseAt, shapeOfAnswer, shapeOfFrame } from "../src/map/path_shape.ts";
import { durationS, indexAt, pointAt, wrapped } from "../src/trace.ts";

const pose = (x, heading, direction, clearance) => ({ x, y: 0, heading, s: x, direction, clearance });
const answer = { path: { poses: [pose(0, 0, 1, 1), pose(1, 0, 1, 0.5), pose(2, 0, 1, 0.4), pose(3, 0, -1, 2)] } };
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);

test("a path is cut where the gear changes", () => {
  const shape = shapeOfAnswer(answer);
  assert.deepEqual(shape.runs, [
    { from: 0, to: 2, gear: 1 },
    { from: 2, to: 3, gear: -1 },
  ]);
  assert.equal(shapeOfAnswer(answer), shape);
  assert.equal(shapeOfAnswer({ path: null }), null);
});

test("poses lie between samples, and headings take the short way round", () => {
  near(poseAt(shapeOfAnswer(answer), 1.25)[0], 1.25);
  near(poseAt(shapeOfAnswer(answer), 99)[0], 3);
  const turning = shapeOfFrame({ poses: [0, 0, 3, 1, 2, 0, -3, 1], length_m: 4 });
  near(turning.s[1], 4);
  near(wrapped(poseAt(turning, 2)[2] - Math.PI), 0);
});

test("clearance and the nearest arc length are looked up", () => {
  const shape = shapeOfAnswer(answer);
  assert.equal(clearanceAt(shape, 1.5), 0.4);
  assert.equal(clearanceAt(shapeOfFrame({ poses: [0, 0, 0, 1], length_m: 0 }), 0), null);
  const { s, distance_m } = nearestOn(shape, 1.5, 2);
  near(s, 1.5);
  near(distance_m, 2);
});

test("a drive is found by time", () => {
  const point = (t_s, heading) => ({ t_s, driven_m: t_s, s_m: t_s, pose: { x: t_s, y: 0, heading }, steer_rad: 0 });
  const driven = { trace: [point(0, 3), point(1, -3), point(2, -3)] };
  assert.equal(durationS(driven), 2);
  assert.equal(durationS({ trace: [] }), 0);
  assert.equal(pointAt({ trace: [] }, 1), null);
  assert.deepEqual([-1, 0, 0.5, 1, 9].map((t) => indexAt(driven.trace, t)), [0, 0, 0, 1, 2]);
  near(pointAt(driven, 0.5).pose.x, 0.5);
  near(wrapped(pointAt(driven, 0.5).pose.heading - Math.PI), 0);
});
