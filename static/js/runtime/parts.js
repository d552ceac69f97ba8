/**
 * What the worker loads beside the interpreter: the simulations, and Python's library and numpy in
 * parts, as `runtime.json` lists them. What the scenes of the page import is fetched while the
 * interpreter starts; anything else when Python asks for it.
 */

import { Fault, fetchWhole, findFault } from "./fault.js";

/** The part of Python's library that the interpreter starts with. */
export const PYTHON = "python.zip";
const LIBRARY = "python";
/** The parts that are imported at once; the others wait until something imports from them. */
export const AT_ONCE = ["numpy", "core"];
/** The part with the sources of all simulations, for who edits them; `editing/` looks for it there. */
export const SOURCES = "simulations";
export const TABLE = "runtime.json";

/**
 * What `runtime.json` says.
 *
 * @typedef {{integrity: Record<string, string>, scenes: Record<string, string[]>,
 *   ladders: Record<string, string[]>, modules: Record<string, string>, lock: object,
 *   folder: string, library: string, libraries: Record<string, string>,
 *   machine_code: string[]}} Table
 */

export class Parts {
  /** @type {Map<string, Promise<Uint8Array>>} */
  #coming = new Map();
  /** @type {Set<string>} */
  #here = new Set();
  /**
   * The interpreter; any, since Pyodide's own types are not at hand.
   *
   * @type {any}
   */
  #pyodide = null;
  /**
   * Scenes that were imported when the interpreter began.
   *
   * @type {Set<string>}
   */
  imported = new Set();
  /** Whether the interpreter began with a memory: with all that is imported at once, but its files. */
  hasMemory = false;
  /** @type {Fault | null} What kept Python last from a part that it asked for. */
  missed = null;

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
   * @param {string} [integrity] Hash of the table, as the page knows it: with it, all files are of
   *   the page's release.
   * @param {boolean} [fresh] Whether to pass by the HTTP cache, which may hold a damaged table.
   * @returns {Promise<Parts>}
   * @throws {import("./fault.js").Fault}
   */
  static async listed(url, integrity, fresh) {
    const reply = await fetchWhole(url + TABLE, integrity, fresh ? ["reload"] : undefined);
    try {
      return new Parts(url, await reply.json());
    } catch {
      throw await findFault(url + TABLE);
    }
  }

  /**
   * The interpreter into which parts are unpacked from now on.
   *
   * @param {any} pyodide
   */
  set pyodide(pyodide) {
    this.#pyodide = pyodide;
  }

  /**
   * The reply with a file that is whole.
   *
   * @param {string} name
   * @param {RequestCache[]} [caches] How it is asked for, one way after the other.
   * @returns {Promise<Response>}
   * @throws {import("./fault.js").Fault}
   */
  reply(name, caches) {
    return fetchWhole(this.url + name, this.table.integrity[name], caches);
  }

  /**
   * The bytes of a file that is whole.
   *
   * @param {string} name
   * @returns {Promise<Uint8Array<ArrayBuffer>>}
   * @throws {import("./fault.js").Fault}
   */
  async fetch(name) {
    return new Uint8Array(await (await this.reply(name)).arrayBuffer());
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
   * What a start that failed has asked for is not asked for again.
   *
   * @param {Parts} other
   */
  takeFrom(other) {
    for (const [name, coming] of other.#coming) this.#coming.set(name, coming);
  }

  /**
   * The parts without which Python is not to run, with what all build on.
   *
   * @param {string[]} [parts] What a scene or a ladder imports.
   */
  toRun(parts = []) {
    return [...(this.hasMemory ? [LIBRARY] : []), ...AT_ONCE, ...parts];
  }

  /**
   * The parts without which a scene cannot be imported. What a memory holds comes later, and machine
   * code: that is imported where a frame needs it.
   *
   * @param {string} scene
   */
  toImport(scene) {
    const parts = this.table.scenes[scene] ?? [];
    if (!this.hasMemory) return this.toRun(parts);
    if (this.imported.has(scene)) return [];
    return parts.filter((part) => !this.table.machine_code.includes(part));
  }

  /**
   * Whether any of these is not yet in place.
   *
   * @param {string[]} names
   */
  lacks(names) {
    return !names.every((name) => this.#here.has(name));
  }

  /**
   * Have parts in place.
   *
   * @param {string[]} names
   * @throws {import("./fault.js").Fault} Where one cannot be had; it is asked for again when it is next needed.
   */
  async provide(names) {
    this.expect(names);
    for (const name of names) {
      const coming = this.#coming.get(name);
      this.#coming.delete(name);
      const archive = await coming;
      if (archive && !this.#here.has(name)) this.#place(name, archive);
    }
  }

  /**
   * Have a part in place at once: Python is in the midst of importing from it.
   *
   * @param {string} name
   * @throws {Fault} Which is kept in `missed`, too: who imports tells of it in words of its own.
   */
  fetchNow(name) {
    if (this.#here.has(name)) return;
    try {
      this.#place(name, loadNow(`${this.url}${name}.zip`));
    } catch (error) {
      this.missed = error instanceof Fault ? error : new Fault("other", `${name}.zip`);
      throw this.missed;
    }
  }

  /** @param {Uint8Array} archive */
  #unpack(archive) {
    this.#pyodide.unpackArchive(archive, "zip", { extractDir: this.table.folder });
  }

  /**
   * @param {string} name
   * @param {Uint8Array} archive
   */
  #place(name, archive) {
    const { FS } = this.#pyodide;
    if (name === LIBRARY) FS.writeFile(this.table.library, archive);
    else if (name === SOURCES) FS.writeFile(`/lib/${name}.zip`, archive);
    else this.#unpack(archive);
    this.#here.add(name);
  }
}

/**
 * An archive, while Python waits.
 *
 * @param {string} url
 * @returns {Uint8Array}
 * @throws {Fault}
 */
function loadNow(url) {
  const request = new XMLHttpRequest();
  request.open("GET", url, false);
  request.responseType = "arraybuffer";
  try {
    request.send();
  } catch {
    throw new Fault("network", url);
  }
  if (request.status !== 200) throw new Fault("status", url, String(request.status));
  const archive = new Uint8Array(request.response);
  if (archive[0] === "<".charCodeAt(0)) throw new Fault("page", url);
  return archive;
}
