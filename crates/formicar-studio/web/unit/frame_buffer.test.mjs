/** Frames kept for playback. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { FrameBuffer } from "../src/frame_buffer.ts";

test("a long run is thinned evenly, and the newest frame and every path stay", () => {
  const frames = [];
  const buffer = new FrameBuffer(frames);
  for (let n = 0; n < 5000; n += 1) {
    buffer.push({ type: "drive", n });
    if (n % 500 === 0) buffer.push({ type: "improved", n });
  }
  assert.ok(frames.length <= 200);
  const drives = frames.filter(({ type }) => type === "drive").map(({ n }) => n);
  assert.equal(drives[0], 0);
  assert.equal(drives.at(-1), 4999);
  const steps = drives.slice(1, -1).map((n, i) => n - drives[i]);
  assert.equal(new Set(steps).size, 1);
  assert.equal(frames.filter(({ type }) => type === "improved").length, 10);
});

test("motions of frames that go are passed on", () => {
  const frames = [];
  const buffer = new FrameBuffer(frames);
  for (let n = 0; n < 1000; n += 1) buffer.push({ type: "expanded", motions: [n, n, n, n] });
  const motions = frames.flatMap((frame) => frame.motions.filter((_, i) => i % 4 === 0));
  assert.deepEqual(motions, Array.from({ length: 1000 }, (_, n) => n));
});
