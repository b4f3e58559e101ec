/** Takes the pictures of the studio that README and book show: `npm run screenshots`. */

import { fileURLToPath } from "node:url";
import { openHall, paint } from "./e2e/hall.mjs";
import { answered, answeredWith, browse, certified, choosePlanner, DESKTOP, nextFrame, openBuiltin, openPanel, PHONE, serve, until } from "./e2e/studio.mjs";

const FOLDER = fileURLToPath(new URL("../../../docs/src/images/", import.meta.url));
const CALM = { reducedMotion: "reduce" };

const server = await serve();
const browser = await browse();

await picture("studio", CALM, async (page) => {
  await certified(page);
  await openBuiltin(page, "parking-lot");
  await certified(page);
});

await picture("studio-compare", { ...CALM, colorScheme: "dark" }, async (page) => {
  await certified(page);
  const panel = await openPanel(page, "compare");
  await panel.getByRole("button", { name: "Compare" }).click();
  await answered(page, "b");
  await until(page, "both are certified", () => document.querySelectorAll('.status-line[data-kind="good"]').length === 2);
});

await picture("studio-steps", CALM, async (page) => {
  await openBuiltin(page, "lei-map1");
  await choosePlanner(page, "lei2020");
  await page.getByRole("button", { name: "Step by step" }).click();
  const next = page.getByRole("button", { name: "Next step" });
  for (let step = 0; step < 4; step += 1) {
    await next.click();
    await nextFrame(page);
  }
  await page.getByText("Nodes removed.").waitFor();
});

await picture("studio-failure", CALM, async (page) => {
  const { plan } = await openHall(page);
  await paint(page, [14, 0.1], [14, 8.7]);
  await paint(page, [14, 19.9], [14, 10.4]);
  await answeredWith(page, ({ gap }) => gap !== null, plan);
});

await picture("studio-phone", { ...CALM, viewport: PHONE, hasTouch: true, isMobile: true, deviceScaleFactor: 2 }, async (page) => {
  await certified(page);
  await page.locator("#tab-charts").click();
});

await browser.close();
await server.end();

/** Opens a page, brings it where the picture is taken, and takes it. */
async function picture(name, settings, act) {
  const context = await browser.newContext({ viewport: DESKTOP, colorScheme: "light", ...settings });
  const page = await context.newPage();
  await page.goto(server.url);
  await act(page);
  await page.mouse.move(0, 0);
  await page.evaluate(() => document.activeElement?.blur());
  await nextFrame(page);
  // Charts follow what the page shows with a delay of their own.
  await until(page, "charts are drawn", () => document.querySelectorAll(".strips canvas, .chart-strips .empty:not([hidden])").length > 0);
  await page.screenshot({ path: `${FOLDER}${name}.png` });
  console.log(`${FOLDER}${name}.png`);
  await context.close();
}
