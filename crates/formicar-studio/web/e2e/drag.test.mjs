/** Start and goal are dragged, and the plan follows; the map is moved and zoomed. */

import assert from "node:assert/strict";
import { answered, certified, drag, lens, nextFrame, openBuiltin, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

const isNear = (pose, [x, y], withinM) => Math.hypot(pose.x - x, pose.y - y) <= withinM;

studio.scene("the plan follows the goal while it is dragged, and is certified where it is let go", {}, async (page) => {
  const first = await answered(page);
  await page.getByRole("button", { name: "across", exact: true }).click();
  const before = await answered(page, "a", first.plan);
  const { goal, pxPerM } = await lens(page);
  const [x, y] = goal;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 4);
  for (let i = 1; i <= 12; i += 1) await page.mouse.move(x, y + 3 * i);

  // The button is still down.
  const held = await until(page, "a path to where the goal is held", () => {
    const { request, slots } = window.formicar.store.state;
    const poses = slots.a.plan?.improved?.poses ?? [];
    const [endX, endY] = poses.slice(-4);
    const [goalX, goalY] = request.goal;
    return Math.hypot(endX - goalX, endY - goalY) < 0.1 && { request, plan: slots.a.plan.plan };
  });
  assert.ok(held.plan > before.plan);
  assert.ok(Math.abs(held.request.goal[1] - before.request.goal[1] + 36 / pxPerM) < 0.01, "as far as the mouse");

  await page.mouse.up();
  const after = await answered(page, "a", held.plan);
  assert.ok(after.isCertified, after.reason);
  assert.ok(isNear(after.poses.at(-1), after.request.goal, 0.05));
  assert.deepEqual(after.request.start, before.request.start);
  await until(page, "what was dragged was drawn", () => window.formicar.stats.dragToDrawnMs.length > 0);

  await page.getByRole("button", { name: "Undo" }).click();
  const undone = await answered(page, "a", after.plan);
  assert.deepEqual(undone.request, before.request);
  assert.ok(isNear(undone.poses.at(-1), before.request.goal, 0.05));
  await page.getByRole("button", { name: "Redo" }).click();
  const redone = await answered(page, "a", undone.plan);
  assert.deepEqual(redone.request, after.request);
});

studio.scene("the start is dragged, and turned by its arrow", {}, async (page) => {
  const parked = await openBuiltin(page, "parking-lot");
  const { start, pxPerM } = await lens(page);
  const heading = parked.request.start[2];
  const front = await see(page, ({ vehicle }) => Math.max(...vehicle.footprint.map(([x]) => x)));
  const reach = Math.max(front * pxPerM + 16, 40);
  const tip = [start[0] + reach * Math.cos(heading), start[1] - reach * Math.sin(heading)];
  const turned = heading + 0.3;
  await drag(page, [tip, [start[0] + reach * Math.cos(turned), start[1] - reach * Math.sin(turned)]]);
  const after = await answered(page, "a", parked.plan);
  assert.deepEqual(after.request.start.slice(0, 2), parked.request.start.slice(0, 2), "it turns where it stands");
  assert.ok(Math.abs(after.request.start[2] - turned) < 0.05, `${after.request.start[2]} is near ${turned}`);
});

studio.scene("the map is panned by the mouse, zoomed by the wheel, and fitted again", {}, async (page) => {
  await certified(page);
  const fitted = await lens(page);
  const box = await page.locator(".map-view").boundingBox();
  const free = [box.x + box.width - 40, box.y + box.height - 30];
  const request = await see(page, (state) => state.request);
  await drag(page, [free, [free[0] - 60, free[1] - 20]]);
  await nextFrame(page);
  const panned = await lens(page);
  assert.ok(Math.abs(panned.goal[0] - fitted.goal[0] + 60) < 1.5 && Math.abs(panned.goal[1] - fitted.goal[1] + 20) < 1.5);
  assert.deepEqual(await see(page, (state) => state.request), request, "only the view has moved");

  const middle = panned.toPx(request.goal);
  await page.mouse.move(...middle);
  await page.mouse.wheel(0, -400);
  await until(page, "it is zoomed", (pxPerM) => {
    const [start, goal] = ["start", "goal"].map((end) => document.querySelector(`.map-handle[data-end=${end}]`).getBoundingClientRect());
    return Math.hypot(start.x - goal.x, start.y - goal.y) > 1.5 * pxPerM;
  }, Math.hypot(fitted.start[0] - fitted.goal[0], fitted.start[1] - fitted.goal[1]));
  const zoomed = await lens(page);
  assert.ok(Math.hypot(zoomed.goal[0] - middle[0], zoomed.goal[1] - middle[1]) < 2, "about the pointer");

  await page.getByRole("button", { name: "Show the whole map" }).click();
  await nextFrame(page);
  const again = await lens(page);
  assert.ok(Math.abs(again.pxPerM - fitted.pxPerM) < 1e-3);
});

studio.scene("pointing at the path tells of the place, in the charts too", {}, async (page) => {
  const { poses } = await answered(page);
  const { toPx } = await lens(page);
  const place = poses[poses.length >> 1];
  await page.mouse.move(...toPx([place.x, place.y]));
  const hoverM = await until(page, "the place is known", () => window.formicar.store.state.hoverM);
  assert.ok(Math.abs(hoverM - place.s) < 1.5, `${hoverM} m is near ${place.s} m`);
  const shown = await until(page, "the charts show it", () => document.querySelector(".strips [role=slider], .strips")?.getAttribute("aria-valuetext"));
  assert.match(shown, /m/);
});
