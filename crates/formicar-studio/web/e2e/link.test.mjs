/** A link restores all that is shown, on another page of the same server. */

import assert from "node:assert/strict";
import { nOccupied, openHall, paint } from "./hall.mjs";
import { answered, answeredWith, certified, openBuiltin, openPanel, replanned, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();

const sceneOf = ({ map, vehicle, request, slots, shown }) => ({
  map: map.name,
  values: [...map.values].reduce((sum, value, i) => (sum * 31 + value + 2 + (i % 7)) % 1_000_000_007, 7),
  vehicle: vehicle.name,
  parameters: vehicle.parameters,
  request,
  slots: [slots.a, slots.b].map((slot) => slot && { config: slot.config, seed: slot.seed, lengthM: slot.plan.end.answer.metrics?.length_m ?? null }),
  shown,
});

async function linkOf(page) {
  const panel = await openPanel(page, "export");
  await panel.getByRole("button", { name: "Copy link" }).click();
  const field = panel.getByLabel("Link to this scene");
  await field.waitFor();
  return until(page, "there is a link", () => document.querySelector("[aria-label='Link to this scene']").value);
}

/** Opens a link on a page of its own, and hands back what it shows. */
async function openedBy(page, link) {
  const other = await page.context().newPage();
  await other.goto(link);
  await answered(other);
  if (await see(page, ({ slots }) => slots.b !== null)) await answered(other, "b");
  const scene = await see(other, sceneOf);
  await other.close();
  return scene;
}

studio.scene("a link restores map, request, configuration and seed of both plans", {}, async (page) => {
  await openBuiltin(page, "narrow-junction");
  await page.locator(".map-handle[data-end=goal]").first().focus();
  await replanned(page, () => page.keyboard.press("ArrowDown"));
  const planner = await openPanel(page, "planner");
  const seed = planner.getByLabel("Seed", { exact: true });
  await replanned(page, async () => {
    await seed.fill("23");
    await seed.press("Enter");
  });
  await planner.getByRole("searchbox", { name: "Find a parameter" }).fill("ants");
  const field = planner.locator(".field[data-hit] input[type=number]:visible").first();
  const value = Number(await field.inputValue()) + 3;
  await replanned(page, async () => {
    await field.fill(String(value));
    await field.press("Enter");
  });
  const compare = await openPanel(page, "compare");
  await compare.getByRole("button", { name: "Compare" }).click();
  await answered(page, "b");

  const link = await linkOf(page);
  assert.match(link, /#scene=1\./);
  const scene = await see(page, sceneOf);
  assert.equal(scene.slots[0].seed, 23);
  assert.notEqual(scene.slots[1], null);
  assert.deepEqual(await openedBy(page, link), scene);
  assert.equal(page.url(), link, "the page's own address is the link");
});

studio.scene("a link restores a map that was painted on", {}, async (page) => {
  const straight = await openHall(page);
  await paint(page, [14, 0.5], [14, 12]);
  await answeredWith(page, ({ lengthM }) => lengthM > 20.5, straight.plan);
  const link = await linkOf(page);
  const scene = await see(page, sceneOf);
  const restored = await openedBy(page, link);
  assert.deepEqual({ ...restored, map: scene.map }, scene);
  assert.ok((await nOccupied(page)) > 2 * (120 + 80) - 4);
});

studio.scene("a damaged link opens the first scene", { hash: "#scene=1.AAAA" }, async (page) => {
  await certified(page);
  assert.equal(await see(page, ({ map }) => map.name), "neighborhood");
});

studio.scene("a link to a map that the server does not know says so, and opens the first scene", {}, async (page) => {
  await certified(page);
  const link = await linkOf(page);
  const unknown = await page.evaluate(async (link) => {
    const bytes = Uint8Array.from(atob(link.split("scene=1.")[1].replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0));
    const through = (stream, bytes) => new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();
    const scene = JSON.parse(new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes)));
    const text = new TextEncoder().encode(JSON.stringify({ ...scene, m: { hash: "0123456789abcdef" } }));
    const packed = new Uint8Array(await through(new CompressionStream("deflate-raw"), text));
    return `#scene=1.${btoa(String.fromCharCode(...packed)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "")}`;
  }, link);
  const other = await page.context().newPage();
  await other.goto(new URL(unknown, page.url()).href);
  await other.getByRole("alert").filter({ hasText: "0123456789abcdef" }).waitFor();
  await certified(other);
  assert.equal(await see(other, ({ map }) => map.name), "neighborhood");
});
