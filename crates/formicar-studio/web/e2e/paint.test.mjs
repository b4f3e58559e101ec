/** Obstacles are painted and erased: the plan goes around, or tells which gap it could not pass. */

import assert from "node:assert/strict";
import { nOccupied, openHall, paint } from "./hall.mjs";
import { answered, answeredWith, certified, drag, lens, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

const highest = ({ poses }) => Math.max(...poses.map(({ y }) => y));

studio.scene("a painted wall is driven around; undo and redo take it away and put it back", {}, async (page) => {
  const straight = await openHall(page);
  assert.ok(Math.abs(straight.lengthM - 20) < 0.05, "straight on");
  const nBefore = await nOccupied(page);
  await paint(page, [14, 0.5], [14, 13]);
  const around = await answeredWith(page, (answer) => answer.isCertified && highest(answer) > 13, straight.plan);
  assert.ok(around.lengthM > 21);
  const nPainted = await nOccupied(page);
  assert.ok(nPainted - nBefore > 50, "a wall of many cells");
  await page.locator("#panel-scene").getByText(", edited").waitFor();
  await certified(page);

  await page.getByRole("button", { name: "Undo" }).click();
  const undone = await answeredWith(page, ({ lengthM }) => lengthM < 20.05, around.plan);
  assert.equal(await nOccupied(page), nBefore);
  await page.keyboard.press("Control+Shift+Z");
  const redone = await answeredWith(page, (answer) => highest(answer) > 13, undone.plan);
  assert.equal(await nOccupied(page), nPainted);
  assert.equal(redone.lengthM, around.lengthM, "the same wall, the same path");

  const { toPx } = await lens(page);
  await page.keyboard.press("e");
  await drag(page, [toPx([14, 8]), toPx([14, 12])]);
  await answeredWith(page, (answer) => answer.isCertified && highest(answer) < 13, redone.plan);
  assert.ok((await nOccupied(page)) < nPainted, "erased");
});

studio.scene("a wall with a gap that is too narrow: the gap is ringed and measured", {}, async (page) => {
  const { plan } = await openHall(page);
  await paint(page, [14, 0.1], [14, 8.9]);
  await paint(page, [14, 19.9], [14, 10.4]);
  const failed = await answeredWith(page, ({ status, gap }) => status !== "found" && gap !== null, plan);
  assert.equal(failed.poses.length, 0);
  assert.ok(failed.gap.gap_m < failed.gap.vehicle_width_m, "narrower than the vehicle");
  assert.ok(Math.hypot(failed.gap.x - 14, failed.gap.y - 9.6) < 1, `the gap is at ${failed.gap.x}, ${failed.gap.y}`);
  await page.locator('.status-line[data-kind="bad"]').waitFor();
  assert.match(await page.locator(".status-line").innerText(), /No path|Not drivable|exhausted/);
  await until(page, "screen readers hear of it", () => !/Certified/.test(document.querySelector("[role=status]").textContent));

  const { toPx } = await lens(page);
  const reddish = await until(page, "the gap is drawn", ringOfGap, { at: toPx([failed.gap.x, failed.gap.y]) });
  assert.ok(reddish > 20);

  await page.getByRole("button", { name: "Undo" }).click();
  const again = await answeredWith(page, ({ isCertified }) => isCertified, failed.plan);
  assert.ok(highest(again) > 10, "through what is open again");
  await certified(page);
});

/** Pixels that are drawn about a place of the window, over map and ways. */
function ringOfGap({ at: [x, y] }) {
  const canvas = document.querySelector(".map-host[data-slot=a] canvas[data-layer=over]");
  const box = canvas.getBoundingClientRect();
  const ratio = canvas.width / box.width;
  const [left, top] = [(x - box.left - 20) * ratio, (y - box.top - 20) * ratio];
  const { data } = canvas.getContext("2d").getImageData(left, top, 40 * ratio, 40 * ratio);
  let n = 0;
  for (let i = 0; i < data.length; i += 4) n += data[i + 3] > 100 && data[i] > data[i + 1] + 40 ? 1 : 0;
  return n;
}

studio.scene("a goal within a wall is refused in words, and the colliding cells are known", {}, async (page) => {
  const { plan } = await openHall(page);
  await paint(page, [25, 7], [25, 13]);
  const refused = await answeredWith(page, ({ status }) => status === "invalid_request", plan);
  assert.match(refused.reason, /goal .*overlaps/);
  assert.ok(refused.collision.cells.length > 3);
  await page.locator('.status-line[data-kind="bad"]', { hasText: "Cannot plan" }).waitFor();
  await page.locator(".status-line", { hasText: "hint" }).waitFor();
});

studio.scene("the brush has a width", {}, async (page) => {
  const { plan } = await openHall(page);
  const before = await nOccupied(page);
  await page.getByRole("button", { name: "Paint obstacles" }).click();
  await page.getByRole("slider", { name: "Brush width" }).fill("0");
  const { toPx } = await lens(page);
  await drag(page, [toPx([14, 16]), toPx([14, 18])]);
  const thin = (await nOccupied(page)) - before;
  assert.ok(thin >= 8 && thin <= 20, `a line of cells: ${thin}`);
  await page.locator(".map-view").first().focus();
  for (let i = 0; i < 8; i += 1) await page.keyboard.press("]");
  assert.ok((await see(page, ({ brushM }) => brushM)) > 1);
  await drag(page, [toPx([18, 16]), toPx([18, 18])]);
  const wide = (await nOccupied(page)) - before - thin;
  assert.ok(wide > 3 * thin, `a broad stroke: ${wide}`);
  await answered(page, "a", plan);
});
