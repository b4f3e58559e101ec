/** Scenes in links. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { decode, encode } from "../src/link.ts";

const catalog = {
  planners: [
    { name: "formicar", config: { planner: "formicar", drive: { n_ants: 10, rule: { rule: "a", x: 1 } }, keep: true } },
    { name: "astar", config: { planner: "astar" } },
  ],
};
const scene = (config, shown = "a") => ({
  map: { builtin: "warehouse" },
  vehicle: { preset: "amr" },
  request: { start: [0, 0, 0], goal: [1.5, 2, 0.1] },
  slots: [{ config, seed: 7 }, { config: { planner: "astar" }, seed: 8 }],
  shown,
});

test("a scene comes back from its link", async () => {
  const configs = [
    catalog.planners[0].config,
    { planner: "formicar", drive: { n_ants: 12, rule: { rule: "a", x: 1 } }, keep: true },
    { planner: "formicar", drive: { n_ants: 10, rule: { rule: "b", y: 2 } }, keep: false },
    { planner: "unknown", own: [1, 2] },
  ];
  for (const config of configs) {
    const full = scene(config, "b");
    assert.deepEqual(await decode(`#${await encode(full, catalog)}`, catalog), full);
  }
});

test("only differences from the catalog are in the link", async () => {
  const same = await encode(scene(catalog.planners[0].config), catalog);
  const other = await encode(scene({ planner: "formicar", drive: {}, keep: false }), catalog);
  assert.ok(same.length < other.length);
  assert.match(same, /^scene=1\.[\w-]+$/);
});

test("a damaged link is no scene", async () => {
  const whole = await encode(scene({ planner: "astar" }), catalog);
  for (const hash of ["", "#", "#scene=", "#scene=2.abc", "#scene=1.!!", `#${whole.slice(0, -9)}`]) {
    assert.equal(await decode(hash, catalog), null, hash);
  }
});
