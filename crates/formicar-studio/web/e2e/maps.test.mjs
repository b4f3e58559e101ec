/** Maps come built in, as files that are chosen, and as files that are dropped. */

import assert from "node:assert/strict";
import { hall, movingAi, pgm, png, rosYaml } from "./files.mjs";
import { answered, certified, openBuiltin, openPanel, see, until, useStudio } from "./studio.mjs";

const studio = useStudio();
const ROWS = hall(64, 48, [[30, 0, 4, 26]]);

const mapOf = ({ map }) => {
  const { name, hash, n_cols, n_rows, resolution_m, origin, values } = map;
  return { name, isOwn: hash !== null, n_cols, n_rows, resolution_m, origin, nOccupied: values.filter((value) => value === 100).length };
};
const N_OCCUPIED = ROWS.flat().filter((cell) => cell === "@").length;
const measures = { isOwn: true, n_cols: 64, n_rows: 48, nOccupied: N_OCCUPIED };

async function choose(page, files) {
  const panel = await openPanel(page, "scene");
  const [chooser] = await Promise.all([
    page.waitForEvent("filechooser"),
    panel.getByRole("button", { name: "Open a file" }).click(),
  ]);
  await chooser.setFiles(files);
}

function opened(page) {
  return until(page, "a map of one's own is open", () => window.formicar.store.state.map?.hash != null);
}

studio.scene("a built-in map comes with its vehicle and its requests", {}, async (page) => {
  const answer = await openBuiltin(page, "warehouse");
  assert.ok(answer.isCertified, answer.reason);
  assert.equal(await see(page, ({ vehicle }) => vehicle.name), "warehouse_amr");
  const panel = page.locator("#panel-scene");
  await panel.getByText("docks, staging lanes").waitFor();
  await panel.getByText("40.0 × 25.0 m, 800 × 500 cells of 0.05 m").waitFor();

  const chips = panel.getByRole("group", { name: "Requests of this map" }).getByRole("button");
  assert.equal(await chips.first().getAttribute("aria-pressed"), "true");
  await chips.nth(1).click();
  const other = await answered(page, "a", answer.plan);
  assert.notDeepEqual(other.request.goal, answer.request.goal);
  assert.ok(other.isCertified, other.reason);
  await until(page, "the chip is pressed", () => document.querySelectorAll(".chips [aria-pressed=true]").length === 1);
  assert.equal(await chips.nth(1).getAttribute("aria-pressed"), "true");
});

studio.scene("a ROS map is opened from its YAML and its image", {}, async (page) => {
  await choose(page, [rosYaml("hall.pgm", 0.25, [-3, 2, 0]), pgm(ROWS)]);
  await opened(page);
  const map = await see(page, mapOf);
  assert.deepEqual(map, { ...measures, name: map.name, resolution_m: 0.25, origin: [-3, 2, 0] });
  const answer = await answered(page);
  assert.ok(answer.isCertified, answer.reason);
  await page.getByText("Your own map. It stays on this machine.").waitFor();
  const label = await page.locator("#panel-scene select[aria-label=Map] option:checked").textContent();
  assert.match(label, /hall/);
});

studio.scene("a MovingAI map is asked for the side of its cells", {}, async (page) => {
  await choose(page, [movingAi(ROWS)]);
  const dialog = page.getByRole("dialog", { name: "Open hall.map" });
  await dialog.getByLabel("Cell size").fill("0.4");
  await dialog.getByRole("button", { name: "Open", exact: true }).click();
  await opened(page);
  const map = await see(page, mapOf);
  assert.deepEqual(map, { ...measures, name: map.name, resolution_m: 0.4, origin: map.origin });
  assert.ok((await answered(page)).isCertified);
});

studio.scene("a file is dropped on the page", {}, async (page) => {
  await certified(page);
  const image = png(ROWS);
  const carried = await page.evaluateHandle(({ name, type, bytes }) => {
    const carried = new DataTransfer();
    carried.items.add(new File([Uint8Array.from(bytes)], name, { type }));
    return carried;
  }, { name: image.name, type: image.mimeType, bytes: [...image.buffer] });
  await page.dispatchEvent("main", "dragover", { dataTransfer: carried });
  await page.getByText("Drop a map: ROS YAML").waitFor();
  await page.dispatchEvent("main", "drop", { dataTransfer: carried });
  await page.getByText("Drop a map: ROS YAML").waitFor({ state: "hidden" });
  const dialog = page.getByRole("dialog", { name: "Open hall.png" });
  await dialog.getByLabel("Cell size").fill("0.3");
  await page.keyboard.press("Enter");
  await opened(page);
  const map = await see(page, mapOf);
  assert.deepEqual(map, { ...measures, name: map.name, resolution_m: 0.3, origin: map.origin });
  assert.ok((await answered(page)).isCertified);
});

studio.scene("a file that is no map is refused in words, and the old map stays", { expects: /400|422|Bad Request|status of 4/ }, async (page) => {
  await certified(page);
  const before = await see(page, ({ map }) => map.name);
  await choose(page, [{ name: "torn.map", mimeType: "text/plain", buffer: Buffer.from("type octile\nheight 9\n") }]);
  await page.getByRole("dialog").getByRole("button", { name: "Open", exact: true }).click();
  const alert = page.getByRole("alert").filter({ hasText: "torn.map" });
  await alert.waitFor();
  assert.equal(await see(page, ({ map }) => map.name), before);
  await alert.getByRole("button", { name: "Close this message" }).click();
  await alert.waitFor({ state: "hidden" });
  await certified(page);
});
