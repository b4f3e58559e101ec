/** Dark and light, by the system's wish and by one's own. */

import assert from "node:assert/strict";
import { certified, inkOf, until, useStudio } from "./studio.mjs";

const studio = useStudio();

/** The brightness of a page and its map, 0 to 255. */
function brightness(page) {
  return page.evaluate(() => {
    const mean = ([r, g, b]) => (r + g + b) / 3;
    const canvas = document.querySelector(".map-host canvas");
    const pixel = canvas.getContext("2d").getImageData(2, canvas.height - 3, 1, 1).data;
    const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
    const color = getComputedStyle(document.body).color.match(/\d+/g).map(Number);
    return { page: mean([r, g, b]), map: mean(pixel), text: mean(color) };
  });
}

for (const colorScheme of ["light", "dark"]) {
  studio.scene(`${colorScheme}, as the system wishes, and the other by a button`, { colorScheme }, async (page) => {
    await certified(page);
    const asWished = await brightness(page);
    const isDark = colorScheme === "dark";
    assert.equal(asWished.page < 100, isDark);
    assert.equal(asWished.map < 100, isDark, "the map too");
    assert.equal(asWished.text > 150, isDark);
    const ink = await inkOf(page, "over");
    const button = page.getByRole("button", { name: /^Theme/ });
    await button.click();
    if (!isDark) await button.click();
    await page.getByRole("button", { name: `Theme: ${isDark ? "light" : "dark"}` }).waitFor();
    await until(page, "the other theme", (isDark) => {
      const [r] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
      return r < 100 !== isDark;
    }, isDark);
    await until(page, "the map follows", (isDark) => {
      const canvas = document.querySelector(".map-host canvas");
      return canvas.getContext("2d").getImageData(2, canvas.height - 3, 1, 1).data[0] < 100 !== isDark;
    }, isDark);
    assert.notEqual(await inkOf(page, "over"), ink, "what is drawn over it too");
  });
}
