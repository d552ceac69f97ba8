/** Starts the Python interpreter, with the simulations and what they import at hand. */

import { Fault, OWN_COPY, replaced } from "./fault.js";
import { CORE, NUMPY, Parts, PYTHON } from "./parts.js";

const SCRIPTS = ["pyodide.mjs", "pyodide.asm.mjs"];
const MACHINE = "pyodide.asm.wasm";
/**
 * @typedef {object} Started
 * @property {string} version Pyodide's.
 * @property {Parts} parts
 * @property {any} python Functions of `simulations.browser`.
 * @property {number} importMs How long it took to import that: how quick the machine is.
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
 * Every file is known to be whole before Python runs, but the machine code, which is before anything
 * is asked of it. Until then all are fetched at once, the scripts are read and the code is compiled.
 *
 * @param {Wanted} wanted
 * @returns {Promise<Started>}
 */
export async function startInterpreter(wanted) {
  const { url, fresh = false, known = false, scenes } = wanted;
  const read = fresh ? [] : SCRIPTS.map((name) => readScript(url + name));
  const early = fresh ? Promise.resolve(null) : compileEarly(url + MACHINE, known);
  const parts = await Parts.listed(url, wanted.table, fresh);
  const { table } = parts;
  const scripts = SCRIPTS.map((name) => parts.reply(name));
  const machine = early.then((found) => parts.reply(MACHINE, found?.again));
  const [library, numpy, core] = [PYTHON, NUMPY, CORE].map((name) => parts.fetch(name));
  const all = Promise.all([...scripts, library, numpy, core]);
  for (const scene of scenes) parts.expect(table.scenes[scene]);
  machine.catch(() => {}); // told below
  const compiled = early.then(async (found) => found?.module ?? compile(await machine));
  const failure = rejection(Promise.all([all, compiled]));
  await Promise.race([Promise.all(scripts), failure]);
  const [{ loadPyodide }, { default: createPyodideModule }] = await Promise.all(
    SCRIPTS.map((name, index) => scriptOf(url + name, read[index])),
  );
  const zipped = library.then((zip) => new Response(/** @type {Uint8Array<ArrayBuffer>} */ (zip)));
  answerWith({ [url + MACHINE]: Promise.resolve(new Response()), [url + PYTHON]: zipped });
  instantiateFrom(compiled);
  const options = {
    indexURL: url,
    stdLibURL: url + PYTHON,
    lockFileContents: JSON.stringify(table.lock),
    createPyodideModule,
  };
  const pyodide = await Promise.race([loadPyodide(options), failure]);
  parts.pyodide = pyodide;
  parts.unpack(await numpy); // its machine code cannot be loaded from within an archive
  parts.unpack(await core);
  const begun = performance.now();
  const module = pyodide.pyimport("simulations.browser");
  const importMs = performance.now() - begun;
  const fetchNow = (/** @type {string} */ part) => parts.fetchNow(part);
  module.fetch_missing(JSON.stringify(table.modules), fetchNow, parts.folder);
  await machine;
  if ((await early) && replaced.has(url + MACHINE)) throw new Fault("other", url + MACHINE);
  return { version: pyodide.version, parts, python: functionsOf(module), importMs };
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
 * @typedef {object} Compiled
 * @property {WebAssembly.Module} module
 * @property {RequestCache[]} again How to ask for the copy that it was compiled from. Asked whether
 *   that is still new, a host would renew it, and the browser forget its code.
 */

/**
 * Machine code, compiled while it arrives. The browser keeps for the next visit what it compiled, but
 * only of a file that was fetched without a hash; whether it is whole is found out afterwards.
 *
 * What it compiled it keeps with its own copy of the file, not with the service worker's: of a file
 * that is known that copy is asked for first, which the service worker lets pass.
 *
 * @param {string} address
 * @param {boolean} known
 * @returns {Promise<Compiled | null>} Nothing where it cannot be had so.
 */
async function compileEarly(address, known) {
  for (const cache of /** @type {RequestCache[]} */ (known ? [OWN_COPY, "default"] : ["default"])) {
    try {
      const reply = fetch(address, { cache, mode: "same-origin" });
      const module = await WebAssembly.compileStreaming(reply);
      return { module, again: [cache === OWN_COPY ? OWN_COPY : "force-cache", "reload"] };
    } catch {
      // The next way, or with the hash at once.
    }
  }
  return null;
}

/**
 * Machine code that came with another type than `application/wasm`, or damaged at first.
 *
 * @param {Response} whole
 * @returns {Promise<WebAssembly.Module>}
 */
async function compile(whole) {
  return WebAssembly.compile(await whole.arrayBuffer());
}

/**
 * Have Pyodide take the machine code that is compiled already.
 *
 * @param {Promise<WebAssembly.Module>} compiled
 */
function instantiateFrom(compiled) {
  WebAssembly.instantiateStreaming = async (_, imports) => {
    const module = await compiled;
    return { module, instance: await WebAssembly.instantiate(module, imports) };
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
