/** Measures the speed of the studio: a page in a real browser, and a hundred clients at once. Prints tables.
 *
 * `npm run measure`, with the release binary built. Nothing of it is tested: figures depend on the
 * machine and on what else it does. */

import { readFile } from "node:fs/promises";
import { cpus, loadavg } from "node:os";
import { setTimeout as pause } from "node:timers/promises";
import { answered, BINARY, browse, certified, DESKTOP, lens, nextFrame, serve, until } from "./e2e/studio.mjs";

const N_DRAGS = 250;
const N_LOADS = 10;
const STREAM_MS = 12_000;
const N_CLIENTS = 100;
const N_PLANS = 20;

const machine = `${cpus().length} x ${cpus()[0].model}`;
console.log(`${machine}, load ${loadavg().map((load) => load.toFixed(2)).join(" ")}, node ${process.version}`);
console.log(`${BINARY}\n`);

const server = await serve();
const browser = await browse();
console.log(`Chromium ${browser.version()} without a graphics card, ${DESKTOP.width} x ${DESKTOP.height}`);
await loads();
await drags();
await streams();
await browser.close();
await visitors();
await server.end();

/** From navigation to the first certified path: come, and drawn. */
async function loads() {
  const figures = [];
  for (let i = 0; i < N_LOADS; i += 1) {
    const page = await freshPage();
    await page.addInitScript(() => {
      const marks = {};
      const look = () => {
        const { slots, frame } = window.formicar?.store.state ?? {};
        const frames = slots?.a.plan?.frames ?? [];
        const first = frames.findIndex(({ type }) => type === "improved");
        if (first >= 0) marks.come ??= performance.now();
        if (first >= 0 && (frame === null || frame >= first)) marks.drawn ??= performance.now();
        if (marks.drawn === undefined) requestAnimationFrame(look);
      };
      requestAnimationFrame(look);
      window.marks = marks;
    });
    await page.goto(server.url);
    await until(page, "a path is drawn", () => window.marks.drawn);
    figures.push(await page.evaluate(() => window.marks));
    await page.context().close();
  }
  table("from navigation, ms", [
    ["first certified path has come", figures.map(({ come }) => come)],
    ["and is drawn, after the race is shown", figures.map(({ drawn }) => drawn)],
  ]);
}

/** From each move of the dragged goal to the path that is drawn for it. */
async function drags() {
  const rows = [];
  for (const request of ["across", "into-alley", "into-dead-end"]) {
    const page = await freshPage({ reducedMotion: "reduce" });
    await page.goto(server.url);
    await certified(page);
    await page.getByRole("button", { name: request, exact: true }).click();
    await until(page, "the request is chosen", (request) => {
      const { map, request: now } = window.formicar.store.state;
      return map.requests.find(({ id }) => id === request).goal.every((value, i) => value === now.goal[i]);
    }, request);
    await answered(page);
    const { goal } = await lens(page);
    await page.evaluate(() => window.formicar.stats.reset());
    await page.mouse.move(...goal);
    await page.mouse.down();
    for (let i = 1, n = 0; n < N_DRAGS && i < 6 * N_DRAGS; i += 1) {
      // Back and forth along the street, as fast as a hand and a screen are.
      await page.mouse.move(goal[0] + Math.sin(i / 5), goal[1] + 10 * Math.sin(i / 25));
      await nextFrame(page);
      n = await page.evaluate(() => window.formicar.stats.dragToDrawnMs.length);
    }
    rows.push([`neighborhood, ${request}`, await page.evaluate(() => window.formicar.stats.dragToDrawnMs)]);
    await page.mouse.up();
    await page.context().close();
  }
  table("from a move of the dragged goal to its path on the canvas, ms", rows);
}

/** Frames drawn while the ants of a long run stream. */
async function streams() {
  const rows = [];
  for (const map of ["neighborhood", "li-neighborhood"]) {
    const page = await freshPage();
    await page.goto(server.url);
    await certified(page);
    await page.getByRole("combobox", { name: "Map" }).selectOption({ label: map });
    await until(page, `${map} is open`, (map) => window.formicar.store.state.map.name === map, map);
    await answered(page);
    await page.locator("#tab-planner").click();
    await page.getByRole("combobox", { name: "Planner" }).selectOption("max-min");
    await until(page, "ants stream", () => window.formicar.store.state.slots.a.plan?.frames.some(({ type }) => type === "iteration"));
    await page.evaluate(() => window.formicar.stats.reset());
    await pause(STREAM_MS);
    rows.push([`${map}, max-min`, await page.evaluate(() => window.formicar.stats.betweenFramesMs)]);
    await page.context().close();
  }
  table("between two frames while ants stream, ms", rows);
  for (const [name, times] of rows) {
    console.log(`${name}: ${((1000 * times.length) / times.reduce((a, b) => a + b, 0)).toFixed(1)} frames per second`);
  }
  console.log();
}

/** Visitors without a browser, all at once: each plans again and again while the goal moves. */
async function visitors() {
  const config = (await (await fetch(`${server.url}api/catalog`)).json()).planners.find(({ name }) => name === "formicar").config;
  const memory = { before: await residentMib(), peak: 0 };
  let isOver = false;
  const watching = (async () => {
    while (!isOver) {
      memory.peak = Math.max(memory.peak, await residentMib());
      await pause(50);
    }
  })();
  const begun = performance.now();
  const visits = await Promise.all(Array.from({ length: N_CLIENTS }, (_, i) => visit(i, config)));
  const tookS = (performance.now() - begun) / 1000;
  isOver = true;
  await watching;
  await pause(1000);
  const all = (key) => visits.flatMap((one) => one[key]);
  const count = (key) => visits.reduce((sum, one) => sum + one[key], 0);
  const statuses = grouped(all("statuses"));
  const result = Object.entries(statuses).map(([status, list]) => `${list.length} ${status}`);
  console.log(`${N_CLIENTS} visitors at once, each plans ${N_PLANS} times on neighborhood with frames: ${tookS.toFixed(1)} s`);
  console.log(`plans asked for ${N_CLIENTS * N_PLANS}, answers ${all("statuses").length} (${result.join(", ")})`);
  console.log(`errors ${count("nErrors")}, lines that broke ${count("nBroken")}, frames ${count("nFrames")}, MiB ${(count("nBytes") / 2 ** 20).toFixed(0)}`);
  table("of a plan, ms", [
    ["to its first path", all("firstMs")],
    ["to its answer", all("answerMs")],
    ["of that in the planner", all("queryMs")],
  ]);
  console.log(`server's memory, MiB: before ${memory.before.toFixed(0)}, peak ${memory.peak.toFixed(0)}, after ${(await residentMib()).toFixed(0)}`);
}

/** One visitor: all that came, and how long it took. */
function visit(index, config) {
  const result = { statuses: [], firstMs: [], answerMs: [], queryMs: [], nErrors: 0, nBroken: 0, nFrames: 0, nBytes: 0 };
  const socket = new WebSocket(`${server.url.replace("http", "ws")}ws`);
  socket.binaryType = "arraybuffer";
  const say = (message) => socket.send(JSON.stringify(message));
  let [plan, askedMs, hasPath] = [0, 0, false];
  const ask = () => {
    plan += 1;
    [askedMs, hasPath] = [performance.now(), false];
    const goal = [110, 86 - 0.2 * ((plan + index) % 20), Math.PI / 2];
    const request = { start: [29.2, 3, Math.PI / 2], goal };
    say({ type: "plan", plan, slot: "a", request, config, seed: index, watch: true });
  };
  return new Promise((done) => {
    socket.onclose = () => {
      if (plan < N_PLANS || result.statuses.length < N_PLANS) result.nBroken += 1;
      done(result);
    };
    socket.onmessage = ({ data }) => {
      const message = JSON.parse(headerOf(data));
      result.nBytes += typeof data === "string" ? data.length : data.byteLength;
      const sinceMs = performance.now() - askedMs;
      if (message.type === "hello") say({ type: "open_map", map: { builtin: "neighborhood" } });
      else if (message.type === "vehicle") ask();
      else if (message.type === "error") result.nErrors += 1;
      else if (message.type === "improved" && !hasPath) {
        hasPath = true;
        result.firstMs.push(sinceMs);
      } else if (message.type === "answer") {
        result.statuses.push(message.answer.status);
        result.answerMs.push(sinceMs);
        result.queryMs.push(1000 * message.answer.timing.query_s);
        if (plan < N_PLANS) ask();
        else socket.close();
      }
      if (["improved", "drive", "expanded"].includes(message.type)) result.nFrames += 1;
    };
  });
}

function headerOf(data) {
  if (typeof data === "string") return data;
  const length = new DataView(data).getUint32(0, true);
  return new TextDecoder().decode(new Uint8Array(data, 4, length));
}

async function residentMib() {
  const status = await readFile(`/proc/${server.pid}/status`, "utf8");
  return Number(/VmRSS:\s+(\d+)/.exec(status)[1]) / 1024;
}

function grouped(values) {
  const groups = {};
  for (const value of values) (groups[value] ??= []).push(value);
  return groups;
}

async function freshPage(options = {}) {
  const context = await browser.newContext({ viewport: DESKTOP, ...options });
  return context.newPage();
}

function table(title, rows) {
  console.log(`${title.padEnd(64)}     n  median     p90     p99     max`);
  for (const [name, values] of rows) {
    const sorted = [...values].sort((a, b) => a - b);
    const at = (share) => sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)] ?? NaN;
    const figures = [at(0.5), at(0.9), at(0.99), at(1)].map((value) => value.toFixed(1).padStart(8));
    console.log(`  ${name.padEnd(62)}${String(sorted.length).padStart(6)}${figures.join("")}`);
  }
  console.log();
}
