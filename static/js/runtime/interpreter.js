/** Starts the Python interpreter, with the simulations and what they import at hand. */

import { NUMPY, Parts, PYTHON, SIMULATIONS } from "./parts.js";

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
 * Every file is known to be whole before any of it runs.
 *
 * @param {string} url The runtime's folder.
 * @param {boolean} fresh Whether the table of its files is to be a new one.
 * @param {string[]} scenes Whose parts are fetched meanwhile.
 * @returns {Promise<Started>}
 */
export async function startInterpreter(url, fresh, scenes) {
  const parts = await Parts.listed(url, fresh);
  const { table } = parts;
  const scripts = SCRIPTS.map((name) => parts.reply(name));
  const [machine, library] = [parts.reply(MACHINE), parts.reply(PYTHON)];
  const [numpy, simulations] = [parts.fetch(NUMPY), parts.fetch(SIMULATIONS)];
  const all = Promise.all([...scripts, machine, library, numpy, simulations]);
  for (const scene of scenes) parts.expect(table.scenes[scene]);
  answerWith({ [url + MACHINE]: machine, [url + PYTHON]: library });
  const options = {
    indexURL: url,
    stdLibURL: url + PYTHON,
    lockFileContents: JSON.stringify(table.lock),
  };
  const failure = Promise.race([rejection(all), webAssemblyFailure()]);
  await Promise.race([Promise.all(scripts), failure]);
  const { loadPyodide } = await import(`${url}pyodide.mjs`);
  const pyodide = await Promise.race([loadPyodide(options), failure]);
  parts.pyodide = pyodide;
  parts.unpack(await numpy); // its machine code cannot be loaded from within an archive
  pyodide.FS.writeFile(`/lib/${SIMULATIONS}`, await simulations);
  pyodide.pyimport("sys").path.append(`/lib/${SIMULATIONS}`);
  const begun = performance.now();
  const module = pyodide.pyimport("simulations.browser");
  const importMs = performance.now() - begun;
  const fetchNow = (/** @type {string} */ part) => parts.fetchNow(part);
  module.fetch_missing(JSON.stringify(table.modules), fetchNow, parts.folder);
  return { version: pyodide.version, parts, python: functionsOf(module), importMs };
}

/**
 * One proxy of each function for good, and not a new one with each call.
 *
 * @param {any} module `simulations.browser`.
 */
function functionsOf(module) {
  const { render, pull, error, photograph, forget, judge, measure, script, prepare } = module;
  const renderEdited = module.render_edited;
  return {
    ...{ render, renderEdited, pull, error, photograph, prepare },
    ...{ forget, judge, measure, script },
  };
}

/**
 * Rejects if the interpreter's WebAssembly cannot be had: Pyodide itself would only warn, and
 * wait for ever. A host that sends it with another type than `application/wasm` is served too.
 *
 * @returns {Promise<never>}
 */
function webAssemblyFailure() {
  return new Promise((_, reject) => {
    const streaming = WebAssembly.instantiateStreaming;
    WebAssembly.instantiateStreaming = async (source, imports) => {
      try {
        const response = await source;
        const typed = response.headers.get("content-type")?.startsWith("application/wasm");
        return typed
          ? await streaming(response, imports)
          : await WebAssembly.instantiate(await response.arrayBuffer(), imports);
      } catch (error) {
        reject(error);
        throw error;
      }
    };
  });
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
