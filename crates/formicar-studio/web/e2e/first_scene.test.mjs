/** The first scene, before any click. */

import assert from "node:assert/strict";
import { answered, certified, inkOf, nextFrame, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

studio.scene("the first scene appears without a click, ants run, and it ends certified", { reducedMotion: "no-preference" }, async (page) => {
  await certified(page);
  const first = await answered(page);
  assert.ok(first.isCertified && first.poses.length > 10, first.reason);
  const scene = await see(page, ({ map, vehicle, slots }) => ({
    map: map.name,
    vehicle: vehicle.name,
    planner: slots.a.config.planner,
    kinds: [...new Set(slots.a.plan.frames.map(({ type }) => type))].sort(),
  }));
  assert.deepEqual(scene, {
    map: "neighborhood",
    vehicle: "sedan",
    planner: "formicar",
    kinds: ["drive", "expanded", "improved"],
  });

  await until(page, "the run has been played to its end", () => window.formicar.store.state.frame === null);
  assert.ok((await page.evaluate(() => window.formicar.stats.nFramesDrawn)) > 20, "it was seen, frame by frame");
  await page.getByText("End of the run").waitFor();
  await until(page, "screen readers hear of it", () => /Certified.*clearance/.test(document.querySelector("[role=status]")?.textContent ?? ""));
});

studio.scene("the race is drawn while it is played", { reducedMotion: "no-preference" }, async (page) => {
  await until(page, "ants run", () => window.formicar.store.state.isPlaying && window.formicar.store.state.frameShare > 0.2);
  const over = await inkOf(page, "over");
  await until(page, "it goes on", () => (window.formicar.store.state.frame ?? Infinity) > 1);
  assert.notEqual(await inkOf(page, "over"), over, "ants have moved");

  const at = await see(page, ({ slots }) => slots.a.plan.frames.findIndex(({ type }) => type === "expanded"));
  await page.getByRole("slider", { name: "Position in the run" }).fill("0");
  const blank = await inkOf(page, "search");
  await page.getByRole("slider", { name: "Position in the run" }).fill(String(at));
  await until(page, "the frame is shown", (at) => window.formicar.store.state.frame === at, at);
  await nextFrame(page);
  assert.notEqual(await inkOf(page, "search"), blank, "hybrid A* has grown");
});

studio.scene("with reduced motion nothing plays by itself", {}, async (page) => {
  await certified(page);
  assert.deepEqual(await see(page, ({ isPlaying, frame }) => ({ isPlaying, frame })), { isPlaying: false, frame: null });
});

studio.scene("a page knows its language, its title and where its parts are", {}, async (page) => {
  await certified(page);
  assert.equal(await page.title(), "formicar studio");
  assert.equal(await page.getAttribute("html", "lang"), "en");
  for (const role of ["banner", "main", "navigation", "complementary"]) await page.getByRole(role).first().waitFor();
});
