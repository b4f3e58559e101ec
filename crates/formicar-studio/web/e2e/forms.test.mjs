/** Forms of planners and vehicles: what is out of range is refused, what is changed is marked. */

import assert from "node:assert/strict";
import { answered, certified, choosePlanner, openBuiltin, openPanel, replanned, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

async function openColony(page) {
  await openBuiltin(page, "lei-map1");
  await choosePlanner(page, "lei2020");
  const panel = await openPanel(page, "planner");
  await panel.locator("summary", { hasText: "Colony" }).click();
  return panel;
}

const fieldOf = (panel, name) => panel.locator(".field:visible", { has: panel.page().getByLabel(name, { exact: true }) });

async function enter(field, text) {
  const input = field.locator("input");
  await input.fill(text);
  await input.press("Enter");
}

studio.scene("a parameter is changed, marked, found and taken back", {}, async (page) => {
  const panel = await openColony(page);
  const field = fieldOf(panel, "Number of ants");
  const preset = await see(page, ({ slots }) => slots.a.config.colony.n_ants);
  assert.equal(Number(await field.locator("input").inputValue()), preset);
  const changed = await replanned(page, () => enter(field, "17"));
  assert.equal(changed.config.colony.n_ants, 17);
  const nAnts = await see(page, ({ slots }) => slots.a.plan.end.history[0].n_ants);
  assert.equal(nAnts, 17, "so many ants walked");
  await panel.locator("summary", { hasText: "1 changed" }).waitFor();

  await panel.getByLabel("Changed only").check();
  assert.equal(await panel.locator(".field:visible").count(), 1);
  await panel.getByLabel("Changed only").uncheck();
  await panel.getByRole("searchbox", { name: "Find a parameter" }).fill("tau");
  await until(page, "fields are found", () => document.querySelectorAll("#panel-planner .field[data-hit]").length > 0);
  assert.equal(await fieldOf(panel, "Number of ants").count(), 0, "others are hidden");
  await panel.getByRole("searchbox", { name: "Find a parameter" }).fill("");

  const reset = await replanned(page, () => field.getByRole("button", { name: "Reset Number of ants" }).click());
  assert.equal(reset.config.colony.n_ants, preset);
  await panel.locator("summary", { hasText: "1 changed" }).waitFor({ state: "detached" });
});

studio.scene("a value out of its range is refused", {}, async (page) => {
  const panel = await openColony(page);
  const field = fieldOf(panel, "Number of ants");
  const before = await see(page, ({ slots }) => ({ plan: slots.a.plan.plan, nAnts: slots.a.config.colony.n_ants }));
  await enter(field, "-3");
  await until(page, "the field says so", () => document.querySelectorAll("#panel-planner [aria-invalid=true]").length === 1);
  const after = await see(page, ({ slots }) => ({ plan: slots.a.plan.plan, nAnts: slots.a.config.colony.n_ants }));
  assert.deepEqual(after, before, "nothing was planned");
  await field.hover();
  await panel.locator(".help-line", { hasText: "colony.n_ants" }).waitFor();
  assert.match(await panel.locator(".help-line").innerText(), /1 to|at least 1/);
  const again = await replanned(page, () => enter(field, "19"));
  assert.equal(again.config.colony.n_ants, 19);
  assert.equal(await panel.locator("[aria-invalid=true]").count(), 0);
});

studio.scene("another rule brings its own parameters", {}, async (page) => {
  const panel = await openColony(page);
  const choice = panel.locator(".choice", { has: page.getByLabel("Evaporation", { exact: true }) });
  const select = choice.locator("select").first();
  const options = await select.locator("option").evaluateAll((all) => all.map(({ value }) => value));
  const current = await select.inputValue();
  const other = options.find((value) => value === "constant");
  assert.notEqual(current, other);
  const fields = () => choice.locator(".nested label").allInnerTexts();
  const before = await fields();
  const answer = await replanned(page, () => select.selectOption(other));
  assert.notDeepEqual(await fields(), before);
  assert.equal(answer.config.colony.evaporation.rule, other);
  const reset = await replanned(page, () => panel.getByRole("button", { name: "Reset all" }).click());
  assert.equal(reset.config.colony.evaporation.rule, current);
  assert.deepEqual(await fields(), before);
});

/** Sees that the page tells what is wrong, and puts the message away. */
async function refused(page, thing, value) {
  const alert = page.getByRole("alert").filter({ hasText: thing });
  await alert.waitFor();
  assert.match(await alert.innerText(), value);
  await alert.getByRole("button", { name: "Close this message" }).click();
  await alert.waitFor({ state: "hidden" });
}

studio.scene("a vehicle's measures are edited, and wrong ones are refused", {}, async (page) => {
  await certified(page);
  const { plan } = await answered(page);
  const panel = await openPanel(page, "vehicle");
  const wheelbase = panel.getByLabel("Wheelbase", { exact: true });
  const old = await wheelbase.inputValue();
  await wheelbase.fill("-1");
  await wheelbase.press("Enter");
  assert.equal(await wheelbase.getAttribute("aria-invalid"), "true");
  // An end that is outside itself.
  await wheelbase.fill("0");
  await wheelbase.press("Enter");
  assert.equal(await wheelbase.getAttribute("aria-invalid"), "true");
  await wheelbase.fill(old);
  await wheelbase.press("Enter");
  assert.equal(await wheelbase.getAttribute("aria-invalid"), null);

  // What only goes wrong together with other measures.
  const track = panel.getByLabel("Track width", { exact: true });
  await track.fill("9");
  await track.press("Enter");
  await refused(page, /track_width_m = 9/, /width of the body/);
  assert.equal(await see(page, ({ vehicle }) => vehicle.name), "sedan", "the old one stays");

  const overhang = panel.getByLabel("Rear overhang", { exact: true });
  await overhang.fill("0.7");
  await overhang.press("Enter");
  const answer = await answered(page, "a", plan);
  assert.ok(answer.isCertified, answer.reason);
  const vehicle = await see(page, ({ vehicle }) => ({ name: vehicle.name, rear: Math.min(...vehicle.footprint.map(([x]) => x)) }));
  assert.deepEqual(vehicle, { name: "own", rear: -0.7 });

  await panel.getByRole("combobox", { name: "Vehicle" }).selectOption("lei2020");
  await until(page, "a preset again", () => window.formicar.store.state.vehicle.name === "lei2020");
});

studio.scene("a handle of the drawing changes the vehicle", {}, async (page) => {
  await certified(page);
  const panel = await openPanel(page, "vehicle");
  const width = await see(page, ({ vehicle }) => vehicle.parameters.width_m);
  const handle = panel.locator(".handle.side");
  const box = await handle.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - 6, { steps: 4 });
  await page.mouse.up();
  await until(page, "it is another width", (width) => window.formicar.store.state.vehicle.parameters.width_m !== width, width);
  assert.equal(await see(page, ({ vehicle }) => vehicle.name), "own");
});
