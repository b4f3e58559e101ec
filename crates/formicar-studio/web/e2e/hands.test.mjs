/** Everything can be reached by keyboard, and by fingers on a phone. */

import assert from "node:assert/strict";
import { openHall } from "./hall.mjs";
import { answered, certified, lens, nextFrame, PHONE, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

const focused = (page) => page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent);

/** Presses tab until what has the focus fits. */
async function tabTo(page, pattern) {
  const seen = [];
  for (let i = 0; i < 80; i += 1) {
    await page.keyboard.press("Tab");
    seen.push(await focused(page));
    if (pattern.test(seen.at(-1))) return;
  }
  assert.fail(`tab never came to ${pattern}: ${seen.join(" > ")}`);
}

studio.scene("with the keyboard alone: panels, tools, the goal, undo, playback, help", {}, async (page) => {
  await openHall(page);
  await tabTo(page, /^Map\. Arrow keys/);
  const before = await lens(page);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("+");
  await nextFrame(page);
  const moved = await lens(page);
  assert.ok(moved.pxPerM > 1.2 * before.pxPerM, "it zooms");
  await page.keyboard.press("f");

  await tabTo(page, /^Goal: x/);
  const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle + getComputedStyle(document.activeElement).boxShadow);
  assert.notEqual(outline, "nonenone", "the focus is seen");
  const first = await answered(page);
  await page.keyboard.press("ArrowDown");
  const down = await answered(page, "a", first.plan);
  assert.ok(Math.abs(first.request.goal[1] - down.request.goal[1] - 0.25) < 1e-6, "by a cell");
  await page.keyboard.press("r");
  const turned = await until(page, "it has turned", (old) => window.formicar.store.state.request.goal[2] - old > 0.08, first.request.goal[2]);
  assert.ok(turned);
  await until(page, "the handle says so", () => /heading 5°/.test(document.activeElement.getAttribute("aria-label")));
  const { plan } = await answered(page);
  await page.keyboard.press("Control+z");
  const undone = await answered(page, "a", plan);
  assert.ok(Math.abs(undone.request.goal[2] - first.request.goal[2]) < 1e-9, "undone");

  for (const [key, tool] of [["p", "paint"], ["e", "erase"], ["m", "move"]]) {
    await page.keyboard.press(key);
    assert.equal(await see(page, (state) => state.tool), tool);
  }
  for (const [key, panel] of [["2", "planner"], ["3", "vehicle"], ["4", "compare"], ["5", "drive"], ["6", "export"], ["1", "scene"]]) {
    await page.keyboard.press(key);
    await page.locator(`#panel-${panel}`).waitFor();
  }
  await page.locator("#tab-scene").focus();
  await page.keyboard.press("ArrowDown");
  assert.equal(await page.getAttribute("#tab-planner", "aria-selected"), "true");

  await page.keyboard.press("?");
  const help = page.getByRole("dialog", { name: "Keys" });
  await help.getByText("paint, erase").waitFor();
  await page.keyboard.press("Escape");
  await help.waitFor({ state: "detached" });
  await page.keyboard.press("c");
  await page.locator("#panel-charts").waitFor({ state: "hidden" });
});

studio.scene("a long run is stopped by Escape", {}, async (page) => {
  await certified(page);
  await page.locator("#tab-planner").click();
  await page.getByRole("combobox", { name: "Planner" }).selectOption("max-min");
  await page.locator('.status-line[data-kind="busy"]').waitFor();
  await page.locator(".map-view").first().focus();
  await page.keyboard.press("Escape");
  const { status } = await answered(page);
  assert.equal(status, "cancelled");
  await page.locator(".status-line", { hasText: "Cancelled" }).waitFor();
});

const ON_PHONE = { viewport: PHONE, hasTouch: true, isMobile: true, deviceScaleFactor: 2 };

/** Touches as fingers make them. Buttons are clicked: a tap of a busy browser is a long press. */
async function fingers(page) {
  const session = await page.context().newCDPSession(page);
  const send = (type, points) =>
    session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  return {
    down: (...points) => send("touchStart", points),
    move: (...points) => send("touchMove", points),
    up: () => send("touchEnd", []),
  };
}

studio.scene("on a phone everything fits, and the panels open from a bar below", ON_PHONE, async (page) => {
  await certified(page);
  const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
  assert.ok(await fits(), "nothing sticks out");
  for (const id of ["planner", "vehicle", "compare", "drive", "export", "charts", "scene"]) {
    await page.locator(`#tab-${id}`).click();
    const panel = page.locator(`#panel-${id}`);
    await panel.waitFor();
    const box = await panel.boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= PHONE.width + 0.5, `${id} fits`);
    assert.ok(await fits(), `nothing sticks out of ${id}`);
  }
  const map = await page.locator(".map-view").first().boundingBox();
  assert.ok(map.height > 200 && map.y < 200, "the map is above");
});

studio.scene("on a phone the goal is dragged by a finger, and two fingers zoom", ON_PHONE, async (page) => {
  const before = await openHall(page);
  const { goal, pxPerM } = await lens(page);
  const [x, y] = goal;
  const touch = await fingers(page);
  await touch.down([x, y]);
  for (let i = 1; i <= 8; i += 1) await touch.move([x, y + 5 * i]);
  await touch.up();
  // Up to a touch's slop as far as the finger.
  const least = before.request.goal[1] - 35 / pxPerM;
  await until(page, "the goal has followed", (least) => window.formicar.store.state.request.goal[1] < least, least);
  const after = await answered(page, "a", before.plan);
  assert.ok(after.isCertified, after.reason);

  const box = await page.locator(".map-view").first().boundingBox();
  const [centerX, centerY] = [box.x + box.width / 2, box.y + box.height / 2];
  const apart = (half) => [[centerX - half, centerY], [centerX + half, centerY]];
  await touch.down(...apart(30));
  for (let half = 35; half <= 90; half += 5) await touch.move(...apart(half));
  await touch.up();
  await nextFrame(page);
  const pinched = await lens(page);
  assert.ok(pinched.pxPerM > 2 * pxPerM, `${pinched.pxPerM} px/m after ${pxPerM}`);
  assert.deepEqual(await see(page, ({ request }) => request), after.request, "a pinch moves no pose");
});

studio.scene("on a phone obstacles are painted by a finger", ON_PHONE, async (page) => {
  await certified(page);
  const { version } = await see(page, ({ map }) => ({ version: map.version }));
  await page.getByRole("button", { name: "Paint obstacles" }).click();
  // A street: what is an obstacle already would not change.
  const [x, y] = (await lens(page)).toPx([70.8, 50]);
  const touch = await fingers(page);
  await touch.down([x, y]);
  for (let i = 1; i <= 6; i += 1) await touch.move([x, y + 4 * i]);
  await touch.up();
  await until(page, "the map has changed", (version) => window.formicar.store.state.map.version > version, version);
  await page.getByRole("button", { name: "Undo" }).click();
  await until(page, "undone", () => window.formicar.store.state.past.canRedo);
});
