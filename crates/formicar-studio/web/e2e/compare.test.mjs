/** Two planners side by side on the same request, and how their answers differ. */

import assert from "node:assert/strict";
import { answered, openBuiltin, openPanel, replanned, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

/** The cells of a row of the table, as texts. */
function rowOf(page, name) {
  const row = page.locator(".differences tr", { has: page.getByRole("rowheader", { name, exact: true }) });
  return row.locator("td").allInnerTexts();
}

const number = (text) => Number(/[−-]?[\d.]+/.exec(text)[0].replace("−", "-"));

studio.scene("two planners are compared, with a table of differences", {}, async (page) => {
  await openBuiltin(page, "narrow-junction");
  const panel = await openPanel(page, "compare");
  await panel.getByRole("button", { name: "Compare" }).click();
  const [a, b] = [await answered(page, "a"), await answered(page, "b")];
  assert.equal(b.config.planner, "hybrid-astar");
  assert.ok(a.isCertified && b.isCertified);
  assert.deepEqual(a.request, b.request);
  assert.equal(await page.locator(".map-host:visible").count(), 2);
  await until(page, "both verdicts are shown", () => document.querySelectorAll('.status-line[data-kind="good"]').length === 2);

  const heads = await page.locator(".differences thead th").allInnerTexts();
  assert.deepEqual(heads, ["A formicar", "B hybrid-astar", "B − A"]);
  assert.deepEqual((await rowOf(page, "Verdict")).slice(0, 2), ["Certified", "Certified"]);
  const [lengthA, lengthB, difference] = await rowOf(page, "Length");
  assert.ok(Math.abs(number(lengthA) - a.lengthM) < 0.06 && Math.abs(number(lengthB) - b.lengthM) < 0.06);
  assert.ok(Math.abs(number(difference) - (b.lengthM - a.lengthM)) < 0.06, `${difference} is the difference`);
  const better = a.lengthM < b.lengthM ? 0 : 1;
  const cells = page.locator(".differences tr", { has: page.getByRole("rowheader", { name: "Length", exact: true }) }).locator("td");
  assert.notEqual(await cells.nth(better).getAttribute("data-better"), null, "the better one is marked");

  const [dragged, other] = [a.plan, b.plan];
  await page.locator(".map-host[data-slot=b] .map-view").click({ position: { x: 5, y: 5 } });
  assert.equal(await see(page, ({ shown }) => shown), "b");
  await page.locator(".map-host[data-slot=a] .map-handle[data-end=goal]").focus();
  await page.keyboard.press("ArrowDown");
  const [movedA, movedB] = [await answered(page, "a", dragged), await answered(page, "b", other)];
  assert.deepEqual(movedA.request, movedB.request, "both plan the same");
  assert.notDeepEqual(movedA.request.goal, a.request.goal);

  await panel.getByRole("button", { name: "Stop comparing" }).click();
  await page.locator(".map-host[data-slot=b]").waitFor({ state: "hidden" });
  assert.equal(await see(page, ({ slots }) => slots.b), null);
  assert.equal(await page.locator(".status-line").count(), 1);
});

studio.scene("two settings of one planner are compared, and their parameters shown", {}, async (page) => {
  await openBuiltin(page, "narrow-junction");
  const panel = await openPanel(page, "compare");
  await panel.getByRole("button", { name: "Compare" }).click();
  await answered(page, "b");
  await replanned(page, () => panel.getByRole("combobox", { name: "Plan B" }).selectOption("formicar"), "b");
  assert.equal((await rowOf(page, "Length"))[2], "=", "the same planner, the same answer");
  await panel.getByRole("combobox", { name: "Plan A" }).selectOption("hybrid-astar");
  await until(page, "plan A is another", () => window.formicar.store.state.slots.a.config.planner === "hybrid-astar");
  await answered(page, "a");
  await until(page, "the table follows", () => /^A hybrid-astar/.test(document.querySelector(".differences th").textContent));
});
