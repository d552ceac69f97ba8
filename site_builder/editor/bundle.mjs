/**
 * Joins the code editor and the packages that it imports into one file, cut down to what is used.
 *
 * Runs beside `code_editor.ts`. Arguments: the folder whose `node_modules` has the packages, and that
 * to write to: `code_editor.js`, and `packages.json` with the licences of what is in it.
 */

import { readFile, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [packages, out] = process.argv.slice(2);
const { build } = createRequire(`${packages}/`)("esbuild");

const { metafile } = await build({
  entryPoints: [resolve("code_editor.ts")],
  absWorkingDir: packages,
  nodePaths: [`${packages}/node_modules`],
  outdir: out,
  bundle: true,
  format: "esm",
  minify: true,
  legalComments: "none", // the page of licences has them in full
  metafile: true,
  target: "es2022",
});
const [output] = Object.values(metafile.outputs);
const folders = Object.keys(output.inputs).map((path) =>
  path.match(/^node_modules\/(@[^/]+\/)?[^/]+/),
);
const names = [...new Set(folders.flatMap((found) => (found ? [found[0]] : [])))].sort();
const described = names.map(async (name) => {
  const folder = `${packages}/${name}`;
  const about = JSON.parse(await readFile(`${folder}/package.json`, "utf8"));
  const text = await readFile(`${folder}/LICENSE`, "utf8");
  return { name: about.name, version: about.version, license: about.license, text };
});
await writeFile(`${out}/packages.json`, JSON.stringify(await Promise.all(described), null, 1));
