/** Bundles `src` into `dist`, which is committed, or into the folder after `--out`: the same sources
 * give the same bytes. */

import { cp, mkdir, readFile } from "node:fs/promises";
import { build, context } from "esbuild";

/** The license of the bundled library. */
const license = await readFile("node_modules/uplot/LICENSE", "utf8");

const place = process.argv.indexOf("--out");
const outdir = place < 0 ? "dist" : process.argv[place + 1];

const options = {
  entryPoints: { app: "src/main.ts" },
  outdir,
  bundle: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  minify: true,
  legalComments: "none",
  banner: { js: `/* Contains uPlot (https://github.com/leeoniya/uPlot):\n\n${license.trim()}\n*/` },
  logLevel: process.argv.includes("--quiet") ? "warning" : "info",
};

await mkdir(outdir, { recursive: true });
await cp("src/index.html", `${outdir}/index.html`);
if (process.argv.includes("--watch")) await (await context(options)).watch();
else await build(options);
