/** The vehicle drives along its path, and replans when something lies in its way. */

import assert from "node:assert/strict";
import { openHall, paint } from "./hall.mjs";
import { answered, certified, openPanel, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();
/** A drive begins by itself. */
const MOVING = { reducedMotion: "no-preference" };

studio.scene("the vehicle drives to the goal, its wheels steer, and charts know where it is", MOVING, async (page) => {
  await certified(page);
  const panel = await openPanel(page, "drive");
  await panel.getByRole("button", { name: "Drive", exact: true }).click();
  await panel.getByText("The vehicle arrives without contact").waitFor();
  const wheels = () => panel.locator(".wheel").evaluateAll((all) => all.map((wheel) => wheel.getAttribute("transform")));
  await until(page, "it drives", () => (window.formicar.store.state.driveS ?? 0) > 0.5);
  await panel.getByRole("button", { name: "Pause the drive" }).click();
  const trace = await see(page, ({ slots }) => slots.a.driven.trace.map(({ t_s, left_wheel_rad, right_wheel_rad }) => [t_s, left_wheel_rad, right_wheel_rad]));
  const [atS, left, right] = trace.find(([, left]) => Math.abs(left) > 0.2);
  assert.notEqual(left, right, "in a curve the wheels stand otherwise");
  const time = panel.getByRole("slider", { name: "Time of the drive" });
  await time.fill(String(atS));
  await until(page, "the wheels turn", () => [...document.querySelectorAll(".wheel")].every((wheel) => !/\(-?0\.00/.test(wheel.getAttribute("transform"))));
  const [before] = await wheels();
  const degrees = Number(/-?[\d.]+/.exec(before)[0]);
  assert.ok(Math.abs(degrees + (left * 180) / Math.PI) < 1, `${degrees} degrees on the screen`);
  await until(page, "the charts know", () => document.querySelectorAll(".mark.car:not([hidden])").length > 0);

  await panel.getByRole("button", { name: "Open loop" }).click();
  await until(page, "the other law drives", () => window.formicar.store.state.slots.a.driven?.law === "open-loop");
  await panel.getByText("without feedback").waitFor();
  await panel.getByRole("button", { name: "Stop", exact: true }).click();
  await until(page, "it has stopped", () => window.formicar.store.state.driveS === null);
});

studio.scene("an obstacle is dropped on the way: it replans from where it is, and arrives", MOVING, async (page) => {
  const straight = await openHall(page);
  const panel = await openPanel(page, "drive");
  // At its top speed the wheels do not follow a way around without feedback.
  await panel.getByRole("button", { name: "Pure pursuit" }).click();
  await panel.getByRole("button", { name: "Drive", exact: true }).click();
  await until(page, "it drives", () => (window.formicar.store.state.driveS ?? 0) > 0.3);
  await panel.getByRole("button", { name: "Pause the drive" }).click();
  // Where a click pauses it depends on the machine, and with it whether the wheels follow the next path in time.
  await panel.getByRole("slider", { name: "Time of the drive" }).fill("1");
  await until(page, "it stands at this time", () => Math.abs(window.formicar.store.state.driveS - 1) < 0.1);
  const moment = await see(page, ({ slots, driveS }) => {
    const { trace } = slots.a.driven;
    const { pose } = trace.findLast(({ t_s }) => t_s <= driveS);
    return { x: pose.x, y: pose.y, lastS: trace.at(-1).t_s };
  });
  assert.ok(moment.x > 4 && moment.x < 14, `on its way at ${moment.x} m`);

  await paint(page, [18, 8.5], [18, 11.5]);
  const away = await until(page, "it is on another way", (plan) => {
    const { slots } = window.formicar.store.state;
    const isOther = slots.a.plan.plan > plan && slots.a.plan.end && slots.a.driven?.plan === slots.a.plan.plan;
    if (!isOther) return null;
    const { request, end } = slots.a.plan;
    return { start: request.start, poses: end.answer.path.poses, tracked: slots.a.driven.tracked, isValid: end.answer.certificate.valid };
  }, straight.plan);
  assert.ok(Math.abs(away.start[0] - moment.x) < 0.5, "from where it is");
  assert.ok(away.isValid && away.tracked);
  assert.ok(away.poses.every(({ x, y }) => Math.abs(x - 18) > 0.3 || Math.abs(y - 10) > 1.5), "around the obstacle");
  assert.deepEqual(await see(page, ({ request }) => request.start), [4, 10, 0], "what was asked stays");
  await panel.getByText("The vehicle arrives without contact").waitFor();
  await panel.getByRole("combobox", { name: "Playback speed" }).selectOption("50");
  await panel.getByRole("button", { name: "Play the drive" }).click();
  await until(page, "it arrives", () => {
    const { slots, driveS } = window.formicar.store.state;
    return driveS !== null && driveS >= slots.a.driven.trace.at(-1).t_s - 1e-6;
  });
});

studio.scene("a way that is shut off stops the vehicle", MOVING, async (page) => {
  await openHall(page);
  const panel = await openPanel(page, "drive");
  await panel.getByRole("button", { name: "Drive", exact: true }).click();
  await until(page, "it drives", () => (window.formicar.store.state.driveS ?? 0) > 0.3);
  await panel.getByRole("button", { name: "Pause the drive" }).click();
  await paint(page, [18, 0.2], [18, 19.8]);
  await panel.getByText("no way on").waitFor();
  await page.locator('.status-line[data-kind="bad"]').waitFor();
  const answer = await until(page, "there is no path", () => window.formicar.store.state.slots.a.plan?.end?.answer.status);
  assert.notEqual(answer, "found");
});

studio.scene("a point does not drive", {}, async (page) => {
  await certified(page);
  const panel = await openPanel(page, "scene");
  await panel.getByRole("combobox", { name: "Map" }).selectOption({ label: "wang-open" });
  await until(page, "the point is there", () => window.formicar.store.state.vehicle?.motion === "point");
  await answered(page);
  const drive = await openPanel(page, "drive");
  assert.equal(await drive.getByRole("button", { name: "Drive", exact: true }).isDisabled(), true);
});
