/** A hall of 30 by 20 m without obstacles, where the sedan goes from left to right. */

import assert from "node:assert/strict";
import { hall, movingAi } from "./files.mjs";
import { answered, certified, drag, lens, openPanel, see, until } from "./studio.mjs";

const POSES = { Start: [4, 10, 0], Goal: [24, 10, 0] };

export async function openHall(page) {
  await certified(page);
  const panel = await openPanel(page, "scene");
  const [chooser] = await Promise.all([
    page.waitForEvent("filechooser"),
    panel.getByRole("button", { name: "Open a file" }).click(),
  ]);
  await chooser.setFiles([movingAi(hall(120, 80))]);
  const dialog = page.getByRole("dialog");
  await dialog.getByLabel("Cell size").fill("0.25");
  await dialog.getByRole("button", { name: "Open", exact: true }).click();
  await until(page, "the hall is open", () => window.formicar.store.state.map?.n_cols === 120);
  for (const [end, pose] of Object.entries(POSES)) await typePose(panel, end, pose);
  const isSet = (poses) => {
    const { start, goal } = window.formicar.store.state.request;
    return JSON.stringify({ Start: start, Goal: goal }) === JSON.stringify(poses);
  };
  await until(page, "the request is set", isSet, POSES);
  const answer = await answered(page);
  assert.ok(answer.isCertified, answer.reason);
  return answer;
}

async function typePose(panel, end, pose) {
  for (const [i, name] of ["x in meters", "y in meters", "heading in degrees"].entries()) {
    const field = panel.getByLabel(`${end}: ${name}`);
    await field.fill(String(pose[i]));
    await field.press("Enter");
  }
}

/** Paints a line of obstacles between two places of the world. */
export async function paint(page, from, to) {
  const { toPx } = await lens(page);
  await page.getByRole("button", { name: "Paint obstacles" }).click();
  await drag(page, [toPx(from), toPx(to)]);
  await page.getByRole("button", { name: "Move: pan" }).click();
}

export function nOccupied(page) {
  return see(page, ({ map }) => map.values.filter((value) => value === 100).length);
}
