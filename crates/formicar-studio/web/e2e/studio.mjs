/** The real binary and a real browser for tests: what happens in a page is watched to its end. */

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdir } from "node:fs/promises";
import { after, before, test } from "node:test";
import { setTimeout as pause } from "node:timers/promises";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const fromRoot = (path) => fileURLToPath(new URL(`../../../../${path}`, import.meta.url));

/** The binary that serves the page; what it serves is embedded in it. */
export const BINARY = process.env.FORMICAR ?? fromRoot("target/release/formicar");
const SHOTS = fromRoot("target/e2e");

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
const CHROMIUM_FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** Longest wait for anything: only a test that fails takes so long. */
export const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 60_000);
const LOOK_EVERY_MS = 40;
export const DESKTOP = { width: 1280, height: 720 };
export const PHONE = { width: 390, height: 844 };

/** Starts `formicar studio`, with more flags if there are any. */
export async function serve(port = 0, flags = []) {
  const words = ["studio", "--port", String(port), ...flags];
  const server = spawn(BINARY, words, { stdio: ["ignore", "ignore", "pipe"] });
  const ended = new Promise((done) => server.once("exit", done));
  const url = await new Promise((ready, failed) => {
    let said = "";
    server.stderr.on("data", (text) => {
      said += text;
      const address = /http:\/\/\S+/.exec(said)?.[0];
      if (address) ready(address);
    });
    server.once("error", failed);
    server.once("exit", (code) => failed(new Error(`${BINARY} ended with ${code}: ${said}`)));
  });
  const end = async () => {
    server.kill("SIGINT");
    await ended;
  };
  return { url, port: Number(new URL(url).port), pid: server.pid, end };
}

/** Starts Chromium. */
export function browse() {
  return chromium.launch({ executablePath: CHROMIUM, args: CHROMIUM_FLAGS });
}

/** A server and a browser for all tests of a file; `scene` defines a test of a page of its own.
 *
 * A scene fails too where its page asks anyone but its server, where the browser reports a breach
 * of the content security policy, or where an error is logged that it does not expect. */
export function useStudio() {
  const studio = { server: null, browser: null, scene };
  before(async () => {
    [studio.server, studio.browser] = await Promise.all([serve(), browse()]);
  });
  after(async () => {
    await studio.browser?.close();
    await studio.server?.end();
  });

  function scene(name, options, body) {
    test(name, async () => {
      const { hash = "", expects = null, ...settings } = options;
      const context = await studio.browser.newContext({
        viewport: DESKTOP,
        // Nothing plays by itself, unless the test is about that.
        reducedMotion: "reduce",
        acceptDownloads: true,
        ...settings,
      });
      context.setDefaultTimeout(PATIENCE_MS);
      try {
        const page = await context.newPage();
        const complaints = watch(page, studio.server.url);
        await page.goto(studio.server.url + hash);
        await body(page).catch((error) => explain(page, name, error));
        const unexpected = complaints.filter((text) => !(expects?.test(text) ?? false));
        assert.deepEqual(unexpected, [], "the page runs without complaint");
      } finally {
        await context.close();
      }
    });
  }

  return studio;
}

/** Collects all that a page must not do. */
function watch(page, url) {
  const complaints = [];
  const origin = new URL(url).host;
  const visit = (address) => {
    const { protocol, host } = new URL(address);
    const isOwn = ["data:", "blob:"].includes(protocol) || host === origin;
    if (!isOwn) complaints.push(`a request to ${address}`);
  };
  page.on("request", (request) => visit(request.url()));
  page.on("websocket", (socket) => visit(socket.url()));
  page.on("pageerror", (error) => complaints.push(error.stack ?? String(error)));
  page.on("console", (message) => {
    const isBad = message.type() === "error" || /Content.Security.Policy/i.test(message.text());
    if (isBad) complaints.push(message.text());
  });
  return complaints;
}

/** Adds to an error what the page shows, in words and as a picture under `target/e2e`. */
async function explain(page, name, error) {
  await mkdir(SHOTS, { recursive: true });
  const path = `${SHOTS}/${name.replace(/\W+/g, "-")}.png`;
  await page.screenshot({ path }).catch(() => null);
  const status = await page.locator(".status").innerText({ timeout: 1000 }).catch(() => "no status line");
  error.message += `\npage: ${status.replace(/\s+/g, " ")}\npicture: ${path}`;
  throw error;
}

/** Waits until `probe`, called in the page, returns something true, and returns it. */
export async function until(page, what, probe, argument) {
  const end = performance.now() + PATIENCE_MS;
  for (;;) {
    const value = await page.evaluate(probe, argument);
    if (value) return value;
    assert.ok(performance.now() < end, `in vain waited until ${what}`);
    await pause(LOOK_EVERY_MS);
  }
}

/** Waits until the page has drawn what has changed. */
export function nextFrame(page) {
  const twice = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(null))));
  return page.evaluate(twice);
}

/** The part of the page's state that `part` selects. */
export function see(page, part) {
  return page.evaluate(`(${part})(window.formicar.store.state)`);
}

/** Waits until the plan for what is asked now is answered, and tells of it. */
export function answered(page, slot = "a", after = 0) {
  const probe = ({ slot, after }) => {
    const { slots, request } = window.formicar.store.state;
    const { plan, config, seed } = slots[slot] ?? {};
    if (!plan?.end || plan.plan <= after) return null;
    if (JSON.stringify(plan.request) !== JSON.stringify(request)) return null;
    const { answer, stages, tightest } = plan.end;
    return {
      plan: plan.plan,
      request,
      config,
      seed,
      status: answer.status,
      isCertified: answer.status === "found" && answer.certificate?.valid === true,
      reason: answer.reason ?? null,
      gap: answer.explanation?.gap ?? null,
      collision: answer.explanation?.collision ?? null,
      lengthM: answer.metrics?.length_m ?? null,
      poses: answer.path?.poses ?? [],
      stages,
      tightest,
    };
  };
  return until(page, `slot ${slot} is answered`, probe, { slot, after });
}

/** Waits for an answer that `fits`: while something is dragged there are many. */
export async function answeredWith(page, fits, after = 0, slot = "a") {
  for (let plan = after; ; ) {
    const answer = await answered(page, slot, plan);
    if (fits(answer)) return answer;
    plan = answer.plan;
  }
}

/** Does something that leads to a new plan, and waits for its answer. */
export async function replanned(page, act, slot = "a") {
  const { plan } = await answered(page, slot);
  await act();
  return answered(page, slot, plan);
}

/** Waits until the status line says that the path is certified. */
export function certified(page) {
  return page.locator('.status-line[data-kind="good"]', { hasText: "Certified" }).first().waitFor();
}

/** Opens a panel; an open one stays open. */
export async function openPanel(page, id) {
  const tab = page.locator(`#tab-${id}`);
  if ((await tab.getAttribute("aria-selected")) !== "true") await tab.click();
  const panel = page.locator(`#panel-${id}`);
  await panel.waitFor();
  return panel;
}

/** Opens a built-in map by its name in the list. */
export async function openBuiltin(page, name) {
  const panel = await openPanel(page, "scene");
  await panel.getByRole("combobox", { name: "Map" }).selectOption({ label: name });
  await until(page, `${name} is open`, (name) => window.formicar.store.state.map?.name === name, name);
  return answered(page);
}

/** Chooses a planner in its panel. */
export async function choosePlanner(page, name) {
  const panel = await openPanel(page, "planner");
  return replanned(page, () => panel.getByRole("combobox", { name: "Planner" }).selectOption(name));
}

/** The map from world to window coordinates, derived from the handles. */
export async function lens(page, slot = "a") {
  const center = async (end) => {
    const box = await page.locator(`.map-host[data-slot=${slot}] .map-handle[data-end=${end}]`).boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const [start, goal] = [await center("start"), await center("goal")];
  const request = await see(page, (state) => state.request);
  const [x, y] = request.start;
  const inWorld = Math.hypot(request.goal[0] - x, request.goal[1] - y);
  const pxPerM = Math.hypot(goal[0] - start[0], goal[1] - start[1]) / inWorld;
  const toPx = ([toX, toY]) => [start[0] + (toX - x) * pxPerM, start[1] - (toY - y) * pxPerM];
  return { start, goal, pxPerM, toPx };
}

/** Drags the mouse from place to place, in pixels of the window. */
export async function drag(page, [from, ...to]) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (const place of to) await page.mouse.move(...place, { steps: 8 });
  await page.mouse.up();
}

/** A sum over the pixels of a layer of a map: another picture, another sum. */
export function inkOf(page, layer, slot = "a") {
  return page.evaluate(
    ({ layer, slot }) => {
      const canvas = document.querySelector(`.map-host[data-slot=${slot}] canvas[data-layer=${layer}]`);
      const { width, height } = canvas;
      const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
      return data.reduce((sum, value, i) => (sum * 31 + value * (1 + (i & 3))) % 1_000_000_007, 7);
    },
    { layer, slot },
  );
}
