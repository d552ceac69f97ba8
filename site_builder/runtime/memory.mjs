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

process.on("uncaughtException", (error) => {
  console.error(error.message); // not the line of Pyodide's script, which is all of it
  process.exit(1);
});
const [pyodideFolder, given, out] = process.argv.slice(2);
const { folder, libraries, archives, modules } = JSON.parse(
  await readFile(`${given}/order.json`, "utf8"),
);

/** Neither the hour nor chance is to be found in it, nor where it was made. */
process.env.TZ = "UTC";
const NOW = Date.UTC(2020, 0);
Date.now = () => NOW;
performance.now = () => 0;
nodeCrypto.randomFillSync = (values) => values.fill(1);
/** What Python would know of this machine; in a browser it may be longer or shorter. */
const HERE = { HOME: "/home/pyodide", LANG: "en_US.UTF-8", _: "./this.program" };
const ELSEWHERE = { ...HERE, HOME: "/home/of/another", LANG: "de_CH_1996_and_longer.UTF-8" };
/** Bytes at the head of a free block of memory that its allocator (dlmalloc) needs; see below. */
const HEAD = 32;
/** Bytes at the end of the memory that are no block. */
const LAST = 128;

const code = await Promise.all(
  Object.entries(libraries).map(async ([path, file]) => [
    `${folder}/${path}`,
    await WebAssembly.compile(await readFile(file)),
  ]),
);
const pyodideFile = (name) => import(pathToFileURL(`${pyodideFolder}/${name}`).href);
const { loadPyodide } = await pyodideFile("pyodide.mjs");
const { default: createPyodideModule } = await pyodideFile("pyodide.asm.mjs");

/**
 * An interpreter, and its memory before Python runs: that is made by machine code alone.
 *
 * @param {object} options Of Pyodide.
 */
async function started(options) {
  let base;
  const pyodide = await loadPyodide({
    indexURL: `${pyodideFolder}/`,
    stdLibURL: `${pyodideFolder}/python.zip`,
    lockFileContents: await readFile(`${given}/lock.json`, "utf8"),
    _sysExecutable: HERE._,
    createPyodideModule(settings) {
      settings.preRun.unshift(async () => {
        settings.addRunDependency("libraries");
        for (const [path, module] of code) {
          const how = { loadAsync: true, nodelete: true };
          settings.preloadedWasm[path] = await settings.loadWebAssemblyModule(
            ...[module, how, path, {}],
          );
        }
        settings.removeRunDependency("libraries");
      });
      settings.onRuntimeInitialized = () => {
        base = { memory: settings.HEAPU8.slice(), heap: settings._sbrk(0) };
        options.seen?.(base);
      };
      return createPyodideModule(settings);
    },
    ...options,
  });
  return { pyodide, base };
}

/**
 * Overwrite what is free. Each block begins with the size of the one before where that is free, its
 * own, and two flags: whether the one before is in use, and whether it is. One that is free has the
 * places of others after that.
 *
 * @param {any} module Emscripten's.
 * @param {number} near An address in the first page of the heap.
 */
function wipe(module, near) {
  const { HEAPU8: bytes, HEAPU32: words } = module;
  const end = module._sbrk(0);
  // Nothing where blocks do not follow each other to the end.
  const freeFrom = (/** @type {number} */ first) => {
    const free = [];
    let place = first;
    while (place < end - LAST) {
      const told = words[(place + 4) >> 2];
      const next = place + (told & ~7);
      const isUsed = Boolean(told & 2);
      if (next - place < 16 || next > end) return null;
      const isLast = next >= end - LAST;
      if (!isLast && Boolean(words[(next + 4) >> 2] & 1) !== isUsed) return null;
      if (!isLast && !isUsed && words[next >> 2] !== next - place) return null;
      if (!isUsed) free.push([place + HEAD, next]);
      place = next;
    }
    return free;
  };
  const places = Array.from({ length: 512 }, (_, index) => near - 128 + 8 * index);
  const free = places.map(freeFrom).find((found) => found);
  if (!free) throw new Error("the memory is not laid out as expected");
  for (const [start, stop] of free) if (start < stop) bytes.fill(0, start, stop);
  bytes.fill(0, module._emscripten_stack_get_end(), module._emscripten_stack_get_current());
}

const { pyodide, base } = await started({
  _makeSnapshot: true,
  env: { ...HERE, PYTHONHASHSEED: "0" },
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
pyodide.runPython(await readFile(`${given}/rest.py`, "utf8"));
wipe(pyodide._module, base.heap);
const snapshot = pyodide._api.makeSnapshot();
const [, begins, length] = new Uint32Array(snapshot.buffer, 0, 3);
const told = JSON.parse(new TextDecoder().decode(snapshot.subarray(48, 48 + length)));

let other;
const seen = (found) => void (other = found);
await started({ _loadSnapshot: new Uint8Array(), env: ELSEWHERE, seen }).catch(() => {});
await writeFile(`${out}/memory`, snapshot.subarray(begins));
await writeFile(`${out}/base`, base.memory);
await writeFile(`${out}/other`, other.memory);
await writeFile(`${out}/told.json`, JSON.stringify({ references: told, heap: base.heap }));
