/**
 * Joins the modules of a page: those that run at once into few files, those that are asked for later
 * into one each, and every worker's into its own.
 *
 * Arguments: the folder with esbuild among its packages, that of the modules, the one to write to, the
 * page's entry, the workers. Writes `taken.json` beside what is joined: the modules that are in it.
 */

import { readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join, relative } from "node:path";

const [packages, folder, out, entry, ...workers] = process.argv.slice(2);
const { build } = createRequire(`${packages}/`)("esbuild");
const BESIDE = /\bnew URL\((["`])(\.[^"`]*)\1, import\.meta\.url\)/g;

/**
 * An address beside a module is written as from where its joined file lies.
 *
 * @param {string} place
 */
const addresses = (place) => ({
  name: "addresses",
  /** @param {import("esbuild").PluginBuild} build */
  setup: ({ onLoad }) =>
    onLoad({ filter: /\.js$/ }, async ({ path }) => ({
      contents: (await readFile(path, "utf8")).replaceAll(BESIDE, (_, quote, address) => {
        const moved = relative(place, join(dirname(path), address));
        return `new URL(${quote}./${moved}${quote}, import.meta.url)`;
      }),
    })),
});

/**
 * @param {string[]} entryPoints
 * @param {boolean} splitting
 */
async function joined(entryPoints, splitting) {
  const place = join(folder, dirname(entryPoints[0]));
  const { metafile } = await build({
    entryPoints: entryPoints.map((name) => join(folder, name)),
    outdir: join(out, dirname(entryPoints[0])),
    absWorkingDir: folder,
    plugins: [addresses(place)],
    splitting,
    bundle: true,
    format: "esm",
    chunkNames: "[name]-[hash]",
    minifySyntax: true,
    minifyWhitespace: true, // names stay: who looks into an error finds the module's own
    charset: "utf8",
    legalComments: "none",
    metafile: true,
    target: "esnext",
  });
  return Object.keys(metafile.inputs).map((name) => name.replace(/^addresses:/, ""));
}

const page = await joined([entry], true);
const own = await Promise.all(workers.map((worker) => joined([worker], false)));
const taken = [...new Set([page, ...own].flat())];
await writeFile(join(out, "taken.json"), JSON.stringify(taken.sort()));
