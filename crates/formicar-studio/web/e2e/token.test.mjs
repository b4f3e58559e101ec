/** A studio behind a token: the page loads and plans, and nobody else gets in. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { answered, browse, certified, PATIENCE_MS, serve } from "./studio.mjs";

test("the page opens with the token of the printed address", async () => {
  const [server, browser] = await Promise.all([serve(0, ["--token", "0123456789abcdef"]), browse()]);
  try {
    const context = await browser.newContext({ reducedMotion: "reduce" });
    context.setDefaultTimeout(PATIENCE_MS);
    const page = await context.newPage();
    const refused = [];
    page.on("response", (response) => {
      if (response.status() >= 400 && !response.url().endsWith("/favicon.ico")) refused.push(response.url());
    });
    assert.match(server.url, /\?token=/);
    await page.goto(server.url);
    const answer = await answered(page);
    assert.equal(answer.isCertified, true);
    await certified(page);
    assert.deepEqual(refused, []);
    // The cookie serves the page without the token, as after a bookmark.
    const again = await page.goto(server.url.replace(/\?.*/, ""));
    assert.equal(again.status(), 200);
    const stranger = await browser.newContext();
    const page2 = await stranger.newPage();
    const shut = await page2.goto(server.url.replace(/\?.*/, ""));
    assert.equal(shut.status(), 401);
  } finally {
    await browser.close();
    await server.end();
  }
});
