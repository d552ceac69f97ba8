/** Starts the Python interpreter, with the simulations and what they import at hand. */

import { Fault, replaced } from "./fault.js";
import { CORE, NUMPY, Parts, PYTHON } from "./parts.js";

const SCRIPTS = ["pyodide.mjs", "pyodide.asm.mjs"];
const MACHINE = "pyodide.asm.wasm";
/**
 * First the copy that was compiled: asked whether it is still new, a host would renew it, and the
 * browser forget its code.
 *
 * @type {RequestCache[]}
 */
const AS_COMPILED = ["force-cache", "reload"];

/**
 * @typedef {object} Started
 * @property {string} version Pyodide's.
 * @property {Parts} parts
 * @property {any} python Functions of `simulations.browser`.
 * @property {number} importMs How long it took to import that: how quick the machine is.
 */

/**
 * Every file is known to be whole before Python runs, but the machine code, which is before anything
 * is asked of it. Until then all are fetched at once, the scripts are read and the code is compiled.
 *
 * @param {string} url The runtime's folder.
 * @param {boolean} fresh Whether the browser may hold damaged copies of its files.
 * @param {string[]} scenes Whose parts are fetched meanwhile.
 * @returns {Promise<Started>}
 */
export async function startInterpreter(url, fresh, scenes) {
  const read = fresh ? [] : SCRIPTS.map((name) => readScript(url + name));
  const early = fresh ? Promise.resolve(null) : compileEarly(url + MACHINE);
  const parts = await Parts.listed(url, fresh);
  const { table } = parts;
  const scripts = SCRIPTS.map((name) => parts.reply(name));
  const machine = early.then(() => parts.reply(MACHINE, AS_COMPILED));
  const [library, numpy, core] = [PYTHON, NUMPY, CORE].map((name) => parts.fetch(name));
  const all = Promise.all([...scripts, library, numpy, core]);
  for (const scene of scenes) parts.expect(table.scenes[scene]);
  machine.catch(() => {}); // told below
  const compiled = early.then(async (module) => module ?? compile(await machine));
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
 * Machine code, compiled while it arrives. The browser keeps for the next visit what it compiled, but
 * only of a file that was fetched without a hash; whether it is whole is found out afterwards.
 *
 * @param {string} address
 * @returns {Promise<WebAssembly.Module | null>} Nothing where it cannot be had so.
 */
async function compileEarly(address) {
  try {
    return await WebAssembly.compileStreaming(fetch(address));
  } catch {
    return null;
  }
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
