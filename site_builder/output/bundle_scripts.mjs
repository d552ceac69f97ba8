/**
 * Bundles the scripts of a page: those that run at once into few files, those that are imported later
 * into one each, and every worker and other script into its own.
 *
 * Arguments: the folder with esbuild among its packages, that of the sources, the one to write to, the
 * page's entry, other scripts. Writes `bundle.json` beside what is bundled: the chunks that the entry
 * imports at once, the files that scripts name by `new URL(…, import.meta.url)`, and errors.
 */

import { existsSync } from "node:fs";
import { readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, extname, join, relative } from "node:path";

const [packages, folder, out, entry, ...others] = process.argv.slice(2);
const { build } = createRequire(`${packages}/`)("esbuild");
const BESIDE = /\bnew URL\((["`])(\.[^"`]*)\1, import\.meta\.url\)/g;
const beside = new Set();

/**
 * An address beside a module is written as from where its bundle lies.
 *
 * @param {string} place
 */
const addresses = (place) => ({
  name: "addresses",
  /** @param {import("esbuild").PluginBuild} build */
  setup: ({ onLoad }) =>
    onLoad({ filter: /\.[jt]s$/ }, async ({ path }) => ({
      loader: extname(path).slice(1),
      contents: (await readFile(path, "utf8")).replaceAll(BESIDE, (_, quote, address) => {
        const target = join(dirname(path), address);
        beside.add(relative(folder, target));
        return `new URL(${quote}./${relative(place, target)}${quote}, import.meta.url)`;
      }),
    })),
});

/**
 * @param {string} name
 * @param {boolean} splitting
 */
async function bundled(name, splitting) {
  const { metafile } = await build({
    entryPoints: [join(folder, name)],
    outdir: join(out, dirname(name)),
    absWorkingDir: out,
    plugins: [addresses(join(folder, dirname(name)))],
    splitting,
    bundle: true,
    format: "esm",
    chunkNames: "[name]-[hash]",
    minifySyntax: true,
    minifyWhitespace: true, // names stay, so that stack traces can be read
    charset: "utf8",
    legalComments: "none",
    logLevel: "silent",
    metafile: true,
    target: "esnext",
  });
  return metafile.outputs;
}

/** @param {Awaited<ReturnType<typeof bundled>>} outputs */
function importedAtOnce(outputs) {
  const found = [entry.replace(/\.ts$/, ".js")];
  for (const name of found) {
    const named = outputs[name].imports.filter(({ kind }) => kind === "import-statement");
    found.push(...named.map(({ path }) => path).filter((path) => !found.includes(path)));
  }
  return found.slice(1);
}

/** @param {any} failure */
function located({ errors }) {
  return errors.map(({ location, text }) => {
    const { file = "", line = 1 } = location ?? {};
    return { path: relative(folder, join(out, file)), line, text };
  });
}

const result = { at_once: [], beside: [], errors: [] };
try {
  result.at_once = importedAtOnce(await bundled(entry, true));
  const sources = [...beside].map((name) => name.replace(/\.js$/, ".ts"));
  const workers = sources.filter((name) => /\.ts$/.test(name) && existsSync(join(folder, name)));
  await Promise.all([...workers, ...others].map((name) => bundled(name, false)));
  result.beside = [...beside];
} catch (failure) {
  if (!failure.errors) throw failure;
  result.errors = located(failure);
}
await writeFile(join(out, "bundle.json"), JSON.stringify(result));
