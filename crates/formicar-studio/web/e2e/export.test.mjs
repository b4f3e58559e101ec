/** Exports: the path, pictures, a command line and a configuration file. */

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { answered, BINARY, certified, openBuiltin, openPanel, PATIENCE_MS, replanned, useStudio } from "./studio.mjs";

const studio = useStudio();
const run = promisify(execFile);

/** Presses a button that saves a file, and reads it. */
async function saved(page, name) {
  const panel = await openPanel(page, "export");
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    panel.getByRole("button", { name, exact: true }).click(),
  ]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

studio.scene("the path is saved as JSON and as CSV", {}, async (page) => {
  const answer = await answered(page);
  const json = await saved(page, "Answer, JSON");
  assert.equal(json.name, "neighborhood-formicar.json");
  const document = JSON.parse(json.bytes.toString());
  assert.equal(document.schema, "formicar/answer/1");
  assert.equal(document.certificate.valid, true);
  assert.equal(document.metrics.length_m, answer.lengthM);

  const csv = await saved(page, "Path, CSV");
  const [head, ...lines] = csv.bytes.toString().trimEnd().split("\n");
  assert.match(head, /^x,y,heading,s,direction,curvature,steer,clearance/);
  assert.equal(lines.length, answer.poses.length);
  const [x, y] = lines.at(-1).split(",").map(Number);
  assert.ok(Math.hypot(x - answer.request.goal[0], y - answer.request.goal[1]) < 0.05);
});

studio.scene("a saved answer passes check, which hashes the path that the server sent", {}, async (page) => {
  await certified(page);
  // Along the axes, where zeros have either sign.
  const answer = await openBuiltin(page, "narrow-junction");
  assert.equal(answer.isCertified, true);
  const json = await saved(page, "Answer, JSON");
  const folder = await mkdtemp(join(tmpdir(), "formicar-e2e-"));
  try {
    const path = join(folder, "answer.json");
    await writeFile(path, json.bytes);
    const { vehicle } = JSON.parse(json.bytes.toString()).provenance;
    const words = ["check", path, "--map", "narrow-junction", "--vehicle", vehicle.name, "--json"];
    const { stdout } = await run(BINARY, words, { timeout: PATIENCE_MS, maxBuffer: 1 << 28 });
    const { valid, matches_record } = JSON.parse(stdout);
    assert.equal(valid, true);
    assert.deepEqual(matches_record, { map: true, vehicle: true, path: true, numbers: true });
  } finally {
    await rm(folder, { recursive: true });
  }
});

studio.scene("the picture is saved as SVG and as PNG", {}, async (page) => {
  await certified(page);
  const svg = await saved(page, "SVG");
  assert.match(svg.name, /\.svg$/);
  assert.match(svg.bytes.toString(), /^(<\?xml[^>]*>\s*)?<svg[\s\S]*<\/svg>\s*$/);
  const png = await saved(page, "PNG");
  assert.equal(png.bytes.subarray(0, 8).toString("latin1"), "\x89PNG\r\n\x1a\n");
  assert.ok(png.bytes.readUInt32BE(16) > 300, "wide enough");
});

studio.scene("the line for a terminal and the configuration file ask for the same path", {}, async (page) => {
  await openBuiltin(page, "narrow-junction");
  const planner = await openPanel(page, "planner");
  const seed = planner.getByLabel("Seed", { exact: true });
  await replanned(page, async () => {
    await seed.fill("11");
    await seed.press("Enter");
  });
  await planner.getByRole("searchbox", { name: "Find a parameter" }).fill("ants");
  const field = planner.locator(".field[data-hit] input[type=number]:visible").first();
  const old = Number(await field.inputValue());
  const answer = await replanned(page, async () => {
    await field.fill(String(old + 1));
    await field.press("Enter");
  });
  assert.equal(answer.seed, 11);

  const panel = await openPanel(page, "export");
  const line = (await panel.locator("pre[aria-label='Command line']").innerText()).replace(/\\\n/g, " ");
  const [program, ...words] = line.trim().split(/\s+/);
  assert.equal(program, "formicar");
  assert.ok(words.some((word) => /^[a-z_.]+=/.test(word)), "the changed parameter is said");
  assert.equal(await lengthOf([...words, "--json"]), answer.lengthM);

  const toml = await saved(page, "TOML");
  assert.equal(toml.name, "formicar.toml");
  const folder = await mkdtemp(join(tmpdir(), "formicar-e2e-"));
  try {
    const path = join(folder, "formicar.toml");
    await writeFile(path, toml.bytes);
    const asked = words.filter((word, i) => word !== "--set" && words[i - 1] !== "--set");
    assert.equal(await lengthOf([...asked, "--config", path, "--json"]), answer.lengthM);
  } finally {
    await rm(folder, { recursive: true });
  }
});

/** The length of the path that the binary finds. */
async function lengthOf(words) {
  const { stdout } = await run(BINARY, words, { timeout: PATIENCE_MS, maxBuffer: 1 << 28 });
  return JSON.parse(stdout).metrics.length_m;
}
