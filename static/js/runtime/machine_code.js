/**
 * Machine code, compiled while it arrives. The browser keeps for the next visit what it compiled, but
 * only of a file that was fetched without a hash; whether it is whole is found out afterwards.
 */

import { Fault, OWN_COPY, replaced } from "./fault.js";

/** @import { Parts } from "./parts.js" */

/**
 * @typedef {object} Early
 * @property {WebAssembly.Module} module
 * @property {RequestCache[]} again How to ask for the copy that it was compiled from. Asked whether
 *   that is still new, a host would renew it, and the browser forget its code.
 */

/**
 * What is compiled of a file before anyone knows its hash.
 *
 * What the browser compiled it keeps with its own copy of the file, not with the service worker's: of
 * a file that is known that copy is asked for first, which the service worker lets pass.
 *
 * @param {string} address
 * @param {boolean} known
 * @returns {Promise<Early | null>} Nothing where it cannot be had so.
 */
export async function compileEarly(address, known) {
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

/** A file of machine code, on its way. */
export class MachineCode {
  #parts;
  #name;
  #early;
  /** @type {Promise<Response> | null} */
  #whole = null;

  /**
   * @param {Parts} parts
   * @param {string} name
   * @param {Promise<Early | null>} early
   */
  constructor(parts, name, early) {
    this.#parts = parts;
    this.#name = name;
    this.#early = early;
    this.module = this.#compiled();
    this.module.catch(() => {}); // told to who asks
  }

  /**
   * Of what came with another type than `application/wasm`, or damaged at first, once it is whole.
   *
   * @returns {Promise<WebAssembly.Module>}
   */
  async #compiled() {
    const early = await this.#early;
    if (!early) return WebAssembly.compile(await (await this.#asked()).arrayBuffer());
    if (!(await this.wasKnown())) this.#asked().catch(() => {}); // likewise
    return early.module;
  }

  /** Whether it is the browser's own copy, which an earlier visit has found whole. */
  async wasKnown() {
    return (await this.#early)?.again[0] === OWN_COPY;
  }

  /**
   * Wait until it is known that it was compiled of a file that is whole.
   *
   * @throws {Fault}
   */
  async judged() {
    await this.#asked();
    const address = this.#parts.url + this.#name;
    if ((await this.#early) && replaced.has(address)) throw new Fault("other", address);
  }

  /** @returns {Promise<Response>} */
  #asked() {
    this.#whole ??= this.#early.then((found) => this.#parts.reply(this.#name, found?.again));
    return this.#whole;
  }
}

/**
 * Have Pyodide take the interpreter's code as it is compiled already.
 *
 * @param {Promise<WebAssembly.Module>} compiled
 */
export function instantiateFrom(compiled) {
  WebAssembly.instantiateStreaming = async (_, imports) => {
    const module = await compiled;
    return { module, instance: await WebAssembly.instantiate(module, imports) };
  };
}

/**
 * Have libraries loaded before Python runs, always in the same order: so each lies at the same place
 * of the memory in all interpreters, and what refers to it holds in any of them.
 *
 * @param {any} settings Emscripten's, of the interpreter that is to be.
 * @param {[path: string, module: Promise<WebAssembly.Module>][]} libraries
 * @returns {Promise<never>} Rejects where one cannot be loaded.
 */
export function loadBefore(settings, libraries) {
  return new Promise((_, reject) => {
    settings.preRun.unshift(async () => {
      settings.addRunDependency("libraries");
      try {
        for (const [path, module] of libraries) {
          const options = { loadAsync: true, nodelete: true };
          settings.preloadedWasm[path] = await settings.loadWebAssemblyModule(
            ...[await module, options, path, {}],
          );
        }
        settings.removeRunDependency("libraries");
      } catch (error) {
        reject(error);
      }
    });
  });
}

/**
 * Paths of the libraries that an interpreter has loaded.
 *
 * @param {any} pyodide
 * @returns {string[]}
 */
export function loadedLibraries(pyodide) {
  const names = Object.keys(pyodide._module.LDSO.loadedLibsByName);
  return names.filter((name) => name.endsWith(".so"));
}
