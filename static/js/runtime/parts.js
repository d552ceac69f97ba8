/**
 * What the worker loads beside the interpreter: the simulations, and Python's library and numpy in
 * parts, as `runtime.json` lists them. What the scenes of the page import is fetched while the
 * interpreter starts; anything else when Python asks for it.
 */

import { message } from "../errors.js";

/** What the interpreter starts with; the other parts wait until something imports from them. */
export const PYTHON = "python.zip";
export const NUMPY = "numpy.zip";
export const SIMULATIONS = "simulations.zip";
export const TABLE = "runtime.json";

/**
 * What `runtime.json` says.
 *
 * @typedef {{integrity: Record<string, string>, scenes: Record<string, string[]>,
 *   ladders: Record<string, string[]>, modules: Record<string, string>, lock: object}} Table
 */

export class Parts {
  /** @type {Map<string, Promise<Uint8Array>>} */
  #coming = new Map();
  /** @type {Set<string>} */
  #here = new Set();
  /** @type {Set<string>} */
  #damaged = new Set();
  /**
   * The interpreter; any, since Pyodide's own types are not at hand.
   *
   * @type {any}
   */
  #pyodide = null;
  /** Where parts are unpacked. */
  folder = "";

  /**
   * @param {string} url The runtime's folder.
   * @param {Table} table
   */
  constructor(url, table) {
    this.url = url;
    this.table = table;
  }

  /**
   * @param {string} url The runtime's folder.
   * @returns {Promise<Parts>}
   */
  static async listed(url) {
    const reply = good(await fetch(url + TABLE));
    return new Parts(url, await reply.json());
  }

  /**
   * The interpreter into which parts are unpacked from now on.
   *
   * @param {any} pyodide
   */
  set pyodide(pyodide) {
    this.#pyodide = pyodide;
    this.folder = pyodide.pyimport("site").getsitepackages().get(0);
  }

  /**
   * The file, if it is whole.
   *
   * @param {string} name
   * @returns {Promise<Uint8Array>}
   */
  async fetch(name) {
    const cache = this.#damaged.has(name) ? "reload" : "default";
    try {
      const reply = await fetch(this.url + name, { cache, integrity: this.table.integrity[name] });
      return new Uint8Array(await good(reply).arrayBuffer());
    } catch (error) {
      this.#damaged.add(name);
      throw new Error(`${name}: ${message(error)}`, { cause: error });
    }
  }

  /**
   * Begin to fetch parts.
   *
   * @param {string[]} [names]
   */
  expect(names = []) {
    for (const name of names) {
      if (this.#here.has(name) || this.#coming.has(name)) continue;
      const coming = this.fetch(`${name}.zip`);
      coming.catch(() => {}); // told to whoever provides it
      this.#coming.set(name, coming);
    }
  }

  /**
   * Have parts in place; one that cannot be had is asked for again by whoever imports it.
   *
   * @param {string[]} [names]
   */
  async provide(names = []) {
    this.expect(names);
    for (const name of names) {
      const coming = this.#coming.get(name);
      const archive = await coming?.catch(() => null);
      this.#coming.delete(name);
      if (archive && !this.#here.has(name)) this.#place(name, archive);
    }
  }

  /**
   * Have a part in place at once: Python is in the midst of importing from it.
   *
   * @param {string} name
   */
  fetchNow(name) {
    if (this.#here.has(name)) return;
    const request = new XMLHttpRequest();
    request.open("GET", `${this.url}${name}.zip`, false);
    request.responseType = "arraybuffer";
    request.send();
    if (request.status !== 200) throw new Error(`${request.responseURL}: ${request.status}`);
    this.#place(name, new Uint8Array(request.response));
  }

  /** @param {Uint8Array} archive */
  unpack(archive) {
    this.#pyodide.unpackArchive(archive, "zip", { extractDir: this.folder });
  }

  /**
   * @param {string} name
   * @param {Uint8Array} archive
   */
  #place(name, archive) {
    this.unpack(archive);
    this.#here.add(name);
  }
}

/**
 * A reply, which must be a good one.
 *
 * @param {Response} reply
 */
function good(reply) {
  if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
  return reply;
}
