/**
 * Joins the code editor and the packages that it imports into one file, cut down to what is used.
 *
 * Runs in a folder with `code_editor.ts` and `node_modules`; writes `out/code_editor.js`, and
 * `out/packages.json`, which tells whose work is in it and under which terms.
 */

import { readFile, writeFile } from "node:fs/promises";
import { build } from "esbuild";

const { metafile } = await build({
  entryPoints: ["code_editor.ts"],
  outdir: "out",
  bundle: true,
  format: "esm",
  minify: true,
  legalComments: "none", // the page of licences has them in full
  metafile: true,
  preserveSymlinks: true, // packages are told apart by their places below `node_modules`
  target: "es2022",
});
const [output] = Object.values(metafile.outputs);
const folders = Object.keys(output.inputs).map((path) =>
  path.match(/^node_modules\/(@[^/]+\/)?[^/]+/),
);
const packages = [...new Set(folders.flatMap((found) => (found ? [found[0]] : [])))].sort();
const told = packages.map(async (folder) => {
  const { name, version, license } = JSON.parse(await readFile(`${folder}/package.json`, "utf8"));
  return { name, version, license, text: await readFile(`${folder}/LICENSE`, "utf8") };
});
await writeFile("out/packages.json", JSON.stringify(await Promise.all(told), null, 1));
