/**
 * Starts the pinned Pyodide as the reader's browser does, imports modules, and writes what its memory
 * holds then, and what it holds before Python runs.
 *
 * Arguments: the folder of Pyodide's files, the one with `order.json`, the one to write to. The order:
 * `folder` where modules belong, `libraries` by path in it to their files of machine code, `archives`
 * of modules to unpack and `modules` to import, in order.
 */

import nodeCrypto from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const [pyodideFolder, given, out] = process.argv.slice(2);
process.on("uncaughtException", (error) => {
  console.error(error.message); // not the line of Pyodide's script, which is all of it
  process.exit(1);
});
/** Neither the hour, the place nor chance is to be found in it. */
process.env.TZ = "UTC";
const NOW = Date.UTC(2020, 0);
Date.now = () => NOW;
performance.now = () => 0;
nodeCrypto.randomFillSync = (values) => values.fill(1);

const order = JSON.parse(await readFile(`${given}/order.json`, "utf8"));
const { folder, archives, modules } = order;
const libraries = await Promise.all(
  Object.entries(order.libraries).map(async ([path, file]) => [
    `${folder}/${path}`,
    await WebAssembly.compile(await readFile(file)),
  ]),
);
const pyodideFile = (name) => import(pathToFileURL(`${pyodideFolder}/${name}`).href);
const { loadPyodide } = await pyodideFile("pyodide.mjs");
const { default: createPyodideModule } = await pyodideFile("pyodide.asm.mjs");
let base, heap, table;
const pyodide = await loadPyodide({
  indexURL: `${pyodideFolder}/`,
  stdLibURL: `${pyodideFolder}/python.zip`,
  lockFileContents: await readFile(`${given}/lock.json`, "utf8"),
  _sysExecutable: "./this.program",
  env: { HOME: "/home/pyodide", LANG: "en_US.UTF-8", PYTHONHASHSEED: "0" },
  _makeSnapshot: true,
  createPyodideModule(settings) {
    settings.preRun.unshift(async () => {
      settings.addRunDependency("libraries"); // in the same order as static/js/runtime/machine_code.ts
      const options = { loadAsync: true, nodelete: true };
      for (const [path, module] of libraries) {
        const loaded = await settings.loadWebAssemblyModule(module, options, path, {});
        settings.preloadedWasm[path] = loaded;
      }
      settings.removeRunDependency("libraries");
    });
    settings.onRuntimeInitialized = () => {
      [base, heap] = [settings.HEAPU8.slice(), settings._sbrk(0)];
      table = settings.wasmTable.length;
    };
    return createPyodideModule(settings);
  },
});
for (const archive of archives) {
  pyodide.unpackArchive(new Uint8Array(await readFile(archive)), "zip", { extractDir: folder });
}
pyodide.runPython(`
import sys
from importlib import import_module
sys.path_importer_cache.pop("${folder}", None)  # it was empty, at the same hour
for name in ${JSON.stringify(modules)}:
    import_module(name)
`);
pyodide.runPython(await readFile(`${given}/settle.py`, "utf8"));
const snapshot = pyodide._api.makeSnapshot();
const [, begins, length] = new Uint32Array(snapshot.buffer, 0, 3);
const references = JSON.parse(new TextDecoder().decode(snapshot.subarray(48, 48 + length)));
await writeFile(`${out}/memory`, snapshot.subarray(begins));
await writeFile(`${out}/base`, base);
await writeFile(`${out}/about.json`, JSON.stringify({ references, heap, table }));
