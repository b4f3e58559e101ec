/** Bundles `src` into `dist`, which is committed: the same sources give the same bytes. */

import { cp, mkdir, readFile } from "node:fs/promises";
import { build, context } from "esbuild";

/** What is bundled from others, with their licenses. */
const license = await readFile("node_modules/uplot/LICENSE", "utf8");

const options = {
  entryPoints: { app: "src/main.ts" },
  outdir: "dist",
  bundle: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  minify: true,
  legalComments: "none",
  banner: { js: `/* Contains uPlot (https://github.com/leeoniya/uPlot):\n\n${license.trim()}\n*/` },
  logLevel: "info",
};

await mkdir("dist", { recursive: true });
await cp("src/index.html", "dist/index.html");
if (process.argv.includes("--watch")) await (await context(options)).watch();
else await build(options);
