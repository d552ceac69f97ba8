/** Starts the Python interpreter, with the simulations and what they import at hand. */

import { Fault, replaced } from "./fault.js";
import { compileEarly, instantiateFrom, loadBefore, MachineCode } from "./machine_code.js";
import { forgetMemory, NO_BYTES, recallMemory } from "./memory.js";
import { Parts, PYTHON } from "./parts.js";
import { shippedMemory } from "./shipped_memory.js";

/** @import { About, Memory } from "./memory.js" */

const SCRIPTS = ["pyodide.mjs", "pyodide.asm.mjs"];
const MACHINE = "pyodide.asm.wasm";
/**
 * How many times as long as Pyodide takes to go on with a memory that the book came with it takes to
 * import the simulations, on the same machine: which has not done that.
 */
const TIMES = 5;
/** Chance is to be another one than when a memory was kept. */
const CHANCE = "import random; random.seed()";

/**
 * @typedef {object} Started
 * @property {string} version Pyodide's.
 * @property {Parts} parts
 * @property {any} python Functions of `simulations.browser`.
 * @property {number} importMs How long it took to import that: how quick the machine is.
 * @property {() => Promise<void>} judge Finds out whether what an earlier visit had found whole still
 *   is; rejects where it is not. Another start will do without.
 */

/**
 * What a page asks for who wants an interpreter.
 *
 * @typedef {object} Wanted
 * @property {string} url The runtime's folder.
 * @property {boolean} [fresh] Whether the browser may hold damaged copies of its files.
 * @property {boolean} [known] Whether it has been started in this browser before.
 * @property {string[]} scenes Whose parts are fetched meanwhile.
 * @property {string} [table] Hash of the table of its files.
 */

/**
 * An interpreter with the simulations imported, and what it was made of.
 *
 * @typedef {object} Imported
 * @property {any} pyodide
 * @property {Parts} parts
 * @property {number} importMs
 * @property {() => Promise<void>} judge
 */

/**
 * From the memory that an earlier visit has kept, else from the one that the book comes with, where it
 * is good; else from nothing.
 *
 * @param {Wanted} wanted
 * @returns {Promise<Started>}
 */
export async function startInterpreter(wanted) {
  const { url, fresh } = wanted;
  const kept = fresh ? forgetMemory(url) : recallMemory(url);
  /** @type {Memory | null} */
  let memory = null;
  /** @type {Parts | null} */
  let asked = null;
  const find = async (/** @type {Parts} */ parts) => {
    asked = parts;
    memory = fresh ? null : ((await kept) ?? shippedMemory(parts));
    return memory;
  };
  const plainly = async (/** @type {Parts} */ parts) => {
    if (asked) parts.takeFrom(asked);
    return null;
  };
  const { pyodide, parts, ...more } = await importSimulations(wanted, find).catch(async (error) => {
    if (error instanceof Fault || !memory) throw error;
    console.warn(error);
    await forgetMemory(url);
    return importSimulations(wanted, plainly);
  });
  const module = pyodide.pyimport("simulations.browser");
  const fetchNow = (/** @type {string} */ part) => parts.fetchNow(part);
  module.fetch_missing(JSON.stringify(parts.table.modules), fetchNow, parts.table.folder);
  return { version: pyodide.version, parts, python: functionsOf(module), ...more };
}

/**
 * Every file is known to be whole before Python runs, but the machine code, which is before anything
 * is asked of it; what an earlier visit has found whole is judged again, but later. Until then all
 * are fetched at once, the scripts are read and the code is compiled.
 *
 * @param {Wanted} wanted
 * @param {(parts: Parts) => Promise<Memory | null>} find What Python is to begin with.
 * @param {object} more Options of Pyodide.
 * @returns {Promise<Imported>}
 */
export async function importSimulations(wanted, find = async () => null, more = {}) {
  const { url, fresh = false, known = false, scenes } = wanted;
  const read = fresh ? [] : SCRIPTS.map((name) => readScript(url + name));
  const early = (/** @type {string} */ name) =>
    fresh ? Promise.resolve(null) : compileEarly(url + name, known);
  const earlyMachine = early(MACHINE);
  const parts = await Parts.listed(url, wanted.table, fresh);
  const { table } = parts;
  const scripts = SCRIPTS.map((name) => parts.reply(name));
  const machine = new MachineCode(parts, MACHINE, earlyMachine);
  const libraries = Object.entries(table.libraries).map(([name, path]) => ({
    path: `${table.folder}/${path}`,
    code: new MachineCode(parts, name, early(name)),
  }));
  const codes = [machine, ...libraries.map(({ code }) => code)];
  const memory = await find(parts);
  parts.hasMemory = memory !== null;
  const library = memory ? Promise.resolve(NO_BYTES) : parts.fetch(PYTHON);
  if (!memory) parts.expect(parts.toRun());
  parts.expect(scenes.flatMap((scene) => parts.toImport(scene)));
  /** @type {{about?: Partial<About> & {scenes: string[]}}} */
  const told = {};
  let restored = 0;
  const failure = rejection(
    Promise.all([...scripts, library, ...codes.map(({ module }) => module)]),
  );
  await Promise.race([Promise.all(scripts), failure]);
  const [{ loadPyodide }, { default: createPyodideModule }] = await Promise.all(
    SCRIPTS.map((name, index) => scriptOf(url + name, read[index])),
  );
  const zipped = library.then((zip) => new Response(/** @type {Uint8Array<ArrayBuffer>} */ (zip)));
  answerWith({ [url + MACHINE]: Promise.resolve(new Response()), [url + PYTHON]: zipped });
  instantiateFrom(machine.module);
  const options = {
    indexURL: url,
    stdLibURL: url + PYTHON,
    lockFileContents: JSON.stringify(table.lock),
    async createPyodideModule(/** @type {any} */ settings) {
      const early = libraries.map(
        ({ path, code }) =>
          /** @type {[string, Promise<WebAssembly.Module>]} */ ([path, code.module]),
      );
      const hindered = loadBefore(settings, early);
      const module = await Promise.race([createPyodideModule(settings), hindered]);
      if (memory) told.about = await memory.goOn(module);
      restored = performance.now();
      return module;
    },
    ...(memory ? { _loadSnapshot: NO_BYTES } : {}),
    ...more,
  };
  const pyodide = await Promise.race([loadPyodide(options), failure]);
  parts.pyodide = pyodide;
  const importMs = TIMES * (performance.now() - restored);
  const { about } = told;
  const begun = about ? { importMs, ...about } : await importNow(pyodide, parts);
  if (about) pyodide.runPython(CHANCE);
  parts.imported = new Set(begun.scenes);
  await Promise.all(codes.map(async (code) => (await code.wasKnown()) || code.judged()));
  const judge = async () => void (await Promise.all(codes.map((code) => code.judged())));
  return { pyodide, parts, importMs: begun.importMs, judge };
}

/**
 * @param {any} pyodide
 * @param {Parts} parts
 * @returns {Promise<About>}
 */
async function importNow(pyodide, parts) {
  await parts.provide(parts.toRun());
  const begun = performance.now();
  pyodide.runPython("import simulations.browser");
  return { scenes: [], importMs: performance.now() - begun };
}

/**
 * A script of Pyodide, which on its own only defines what is called later; nothing where it cannot
 * be read.
 *
 * @param {string} address
 * @returns {Promise<any>}
 */
function readScript(address) {
  return import(address).catch(() => null);
}

/**
 * The script that has been read, unless that was a damaged copy.
 *
 * @param {string} address Of a file that is whole.
 * @param {Promise<any>} [read]
 */
async function scriptOf(address, read) {
  const script = replaced.has(address) ? null : await read;
  return script ?? (await import(read ? `${address}?again` : address));
}

/**
 * One proxy of each function for good, and not a new one with each call.
 *
 * @param {any} module `simulations.browser`.
 */
function functionsOf(module) {
  const { render, pull, error, photograph, forget, judge, measure, script } = module;
  const { prepare, warm, render_edited: renderEdited } = module;
  return {
    ...{ render, renderEdited, pull, error, photograph, prepare, warm },
    ...{ forget, judge, measure, script },
  };
}

/**
 * Have Pyodide's own requests for files answered by what has been found whole.
 *
 * @param {Record<string, Promise<Response>>} replies By address.
 */
function answerWith(replies) {
  const fetchOther = self.fetch;
  self.fetch = (address, options) => replies[String(address)] ?? fetchOther(address, options);
}

/**
 * Rejects as `promise` does, and never resolves.
 *
 * @param {Promise<unknown>} promise
 * @returns {Promise<never>}
 */
function rejection(promise) {
  return new Promise((_, reject) => promise.catch(reject));
}
