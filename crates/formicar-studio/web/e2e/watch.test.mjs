/** A colony's run is watched: played, paused, stepped, scrubbed, and shown step by step. */

import assert from "node:assert/strict";
import { choosePlanner, inkOf, nextFrame, openBuiltin, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

async function openColony(page) {
  await openBuiltin(page, "lei-map1");
  const answer = await choosePlanner(page, "lei2020");
  assert.ok(answer.isCertified, answer.reason);
  return answer;
}

const slider = (page) => page.getByRole("slider", { name: "Position in the run" });
const frameOf = (page) => see(page, ({ frame }) => frame);

studio.scene("a run is played, paused, stepped and scrubbed", {}, async (page) => {
  await openColony(page);
  const nFrames = await see(page, ({ slots }) => slots.a.plan.frames.length);
  assert.ok(nFrames > 10 && nFrames <= 200, `${nFrames} frames`);
  const kinds = await see(page, ({ slots }) => [...new Set(slots.a.plan.frames.map(({ type }) => type))]);
  assert.ok(kinds.includes("iteration"));
  assert.equal(await slider(page).getAttribute("max"), String(nFrames));
  await page.getByText("End of the run").waitFor();

  await page.getByRole("button", { name: "Play the run" }).click();
  await until(page, "it plays", () => (window.formicar.store.state.frame ?? 0) >= 2);
  await page.getByRole("button", { name: "Pause" }).click();
  const paused = await frameOf(page);
  assert.ok(paused >= 2 && paused < nFrames);
  assert.equal(await see(page, ({ isPlaying }) => isPlaying), false);

  await page.getByRole("button", { name: "Step ahead" }).click();
  assert.equal(await frameOf(page), paused + 1);
  await page.getByRole("button", { name: "Step back" }).click();
  await page.getByRole("button", { name: "Step back" }).click();
  assert.equal(await frameOf(page), paused - 1);

  await slider(page).fill("0");
  await until(page, "the first frame is described", () => /iteration 1:/.test(document.querySelector(".player-words").textContent));
  await nextFrame(page);
  const [ground, ants] = [await inkOf(page, "base"), await inkOf(page, "over")];
  await slider(page).fill(String(Math.floor(nFrames / 2)));
  await until(page, "another frame is described", () => !/iteration 1:/.test(document.querySelector(".player-words").textContent));
  await nextFrame(page);
  assert.notEqual(await inkOf(page, "base"), ground, "pheromone has changed");
  assert.notEqual(await inkOf(page, "over"), ants, "ants have changed");
  assert.match(await slider(page).getAttribute("aria-valuetext"), /\d+ of \d+ arrived/);

  await slider(page).press("End");
  await page.getByText("End of the run").waitFor();
  assert.equal(await frameOf(page), null);
});

studio.scene("the keys of a player", {}, async (page) => {
  await openColony(page);
  await page.locator(".map-view").first().focus();
  await page.keyboard.press(",");
  const last = await see(page, ({ slots }) => slots.a.plan.frames.length - 1);
  assert.equal(await frameOf(page), last);
  await page.keyboard.press(".");
  assert.equal(await frameOf(page), null);
  await page.keyboard.press(" ");
  await until(page, "it plays", () => window.formicar.store.state.isPlaying && window.formicar.store.state.frame > 0);
  await page.keyboard.press(" ");
  assert.equal(await see(page, ({ isPlaying }) => isPlaying), false);
});

studio.scene("the steps of a plan are shown one by one", {}, async (page) => {
  const { stages } = await openColony(page);
  assert.ok(stages.expanded.length > 0 && stages.closed.length > 0, "obstacles grow, and U-shapes are closed");
  await page.getByRole("button", { name: "Step by step" }).click();
  const card = page.getByRole("region", { name: "The plan step by step" });
  const next = card.getByRole("button", { name: "Next step" });
  const shown = [];
  for (;;) {
    await nextFrame(page);
    shown.push({ words: await card.locator(".stepper-words").innerText(), ink: (await inkOf(page, "base")) + (await inkOf(page, "over")) });
    if (await next.isDisabled()) break;
    await next.click();
  }
  const titles = shown.map(({ words }) => words.split(".")[0]);
  assert.deepEqual(titles, ["The map", "Obstacles expanded", "U-shapes closed", "The path over cells", "Nodes removed", "Arcs fitted", "Judged"]);
  assert.match(shown[1].words, new RegExp(`${stages.expanded.length / 2} cells`));
  assert.match(shown[2].words, new RegExp(`${stages.closed.length / 2} cells`));
  assert.match(shown[6].words, /certifies it/);
  assert.ok(new Set(shown.map(({ ink }) => ink)).size >= 6, "each step is another picture");

  await card.getByRole("button", { name: "Previous step" }).click();
  await card.getByText("Arcs fitted.").waitFor();
  await page.keyboard.press("Escape");
  await card.waitFor({ state: "hidden" });
  assert.equal(await see(page, ({ step }) => step), null);
});

studio.scene("costs and evaporation are drawn over iterations, and lead to their frames", {}, async (page) => {
  await openColony(page);
  const plot = page.locator(".convergence-plot .u-over");
  await plot.waitFor();
  for (const key of ["best so far", "mean", "ρ"]) await page.locator(".keys-of-chart").getByText(key, { exact: true }).waitFor();
  const { width, height } = await plot.boundingBox();
  await plot.click({ position: { x: width / 2, y: height / 2 } });
  const frame = await until(page, "a frame is shown", () => window.formicar.store.state.frame);
  const iteration = await see(page, ({ slots, frame }) => slots.a.plan.frames[frame].record.iteration);
  const last = await see(page, ({ slots }) => slots.a.plan.end.history.at(-1).iteration);
  assert.ok(Math.abs(iteration / last - 0.5) < 0.15, `iteration ${iteration} of ${last} at frame ${frame}`);
});

studio.scene("a run of ants gives way to one that drives, and charts follow", {}, async (page) => {
  await openBuiltin(page, "wang-open");
  const keys = page.locator(".keys-of-chart");
  await keys.getByText("ρ", { exact: true }).waitFor();
  await openBuiltin(page, "neighborhood");
  await keys.getByText("certified path").waitFor();
  await openBuiltin(page, "wang-open");
  await keys.getByText("ρ", { exact: true }).waitFor();
});

studio.scene("ants and pheromone can be left out of the picture", {}, async (page) => {
  await openColony(page);
  await slider(page).fill("3");
  await nextFrame(page);
  const [ground, ants] = [await inkOf(page, "base"), await inkOf(page, "over")];
  await page.getByLabel("Layers").click();
  await page.getByLabel("Pheromone").uncheck();
  await nextFrame(page);
  assert.notEqual(await inkOf(page, "base"), ground);
  await page.getByLabel("Ants and search").uncheck();
  await nextFrame(page);
  assert.notEqual(await inkOf(page, "over"), ants);
});
