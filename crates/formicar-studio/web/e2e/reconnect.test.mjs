/** The server goes away and comes back; the page keeps what it has. */

import assert from "node:assert/strict";
import { nOccupied, openHall, paint } from "./hall.mjs";
import { answered, answeredWith, certified, openBuiltin, see, serve, until, useStudio } from "./studio.mjs";

const studio = useStudio();
const expects = /WebSocket|ERR_CONNECTION_REFUSED|ERR_EMPTY_RESPONSE/;

studio.scene("after a restart of the server the page goes on with the same scene", { expects }, async (page) => {
  await openBuiltin(page, "narrow-junction");
  await page.locator(".map-handle[data-end=goal]").first().focus();
  await page.keyboard.press("ArrowDown");
  const before = await answered(page);
  await restart(page);
  const after = await answered(page, "a", before.plan);
  assert.deepEqual(after.request, before.request);
  assert.equal(after.lengthM, before.lengthM);
  await certified(page);
});

studio.scene("what was painted on a built-in map is still there", { expects }, async (page) => {
  await certified(page);
  const straight = await answered(page);
  const place = straight.poses[straight.poses.length >> 1];
  const across = [-6, 6].map((off) => [place.x - off * Math.sin(place.heading), place.y + off * Math.cos(place.heading)]);
  await paint(page, ...across);
  const around = await answeredWith(page, ({ lengthM }) => lengthM !== straight.lengthM, straight.plan);
  const n = await nOccupied(page);
  await restart(page);
  const after = await answered(page, "a", around.plan);
  assert.equal(after.lengthM, around.lengthM, "the server knows of the obstacle");
  assert.equal(await nOccupied(page), n);
});

studio.scene("a map of one's own, painted on, that the server has forgotten: it gets it from the page", { expects }, async (page) => {
  const straight = await openHall(page);
  await paint(page, [14, 6], [14, 14]);
  const around = await answeredWith(page, ({ lengthM }) => lengthM > straight.lengthM + 0.1, straight.plan);
  const map = await see(page, ({ map }) => ({ ...map, values: [...map.values] }));
  await restart(page);
  const after = await answered(page, "a", around.plan);
  assert.ok(after.isCertified, after.reason);
  assert.equal(after.lengthM, around.lengthM);
  assert.deepEqual(await see(page, ({ map }) => ({ ...map, values: [...map.values] })), map);
});

/** Ends the server, sees that the page tells, and starts it again at the same port. */
async function restart(page) {
  const { port } = studio.server;
  await studio.server.end();
  await page.locator(".status-line", { hasText: "No connection" }).waitFor();
  studio.server = await serve(port);
  await until(page, "the line stands again", () => window.formicar.store.state.isConnected);
}
