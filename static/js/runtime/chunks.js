/**
 * What the worker loads beside the interpreter: the simulations, Python's library and numpy, in
 * chunks that `runtime.json` lists. What the page's scenes import is fetched while the interpreter
 * starts; anything else when Python asks for it.
 */

import { LoadError, fetchWhole, findLoadError } from "./load_error.js";

/** Python's library, which stays an archive. */
const LIBRARY = "python";
/** The sources of all simulations, for those who edit them; `simulations/editing/` looks for them. */
export const SOURCES = "simulations";
const TABLE = "runtime.json";

/**
 * What `runtime.json` says.
 *
 * @typedef {{integrity: Record<string, string>, scenes: Record<string, string[]>,
 *   ladders: Record<string, string[]>, modules: Record<string, string>, lock: object,
 *   folder: string, library: string, libraries: Record<string, string>,
 *   machine_code: string[]}} Table
 */

export class Chunks {
  /** @type {Map<string, Promise<Uint8Array>>} */
  #arriving = new Map();
  /** @type {Set<string>} */
  #present = new Set();
  /** The interpreter into which chunks are unpacked: Pyodide has no types here. @type {any} */
  pyodide = null;
  /** Whether the interpreter continued from a snapshot, which has the modules but not their files. */
  hasSnapshot = false;
  /** @type {LoadError | null} Why Python's last import of a module failed. */
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
   * @param {string} [integrity] Hash of the table, as the page knows it.
   * @param {boolean} [fresh] Whether to bypass the HTTP cache, which may hold a damaged table.
   * @returns {Promise<Chunks>}
   * @throws {LoadError}
   */
  static async listed(url, integrity, fresh) {
    const reply = await fetchWhole(url + TABLE, integrity, fresh ? ["reload"] : undefined);
    try {
      return new Chunks(url, await reply.json());
    } catch {
      throw await findLoadError(url + TABLE);
    }
  }

  /**
   * The reply with a whole file.
   *
   * @param {string} name
   * @returns {Promise<Response>}
   * @throws {LoadError}
   */
  reply(name) {
    return fetchWhole(this.url + name, this.table.integrity[name]);
  }

  /**
   * Begin to fetch chunks.
   *
   * @param {string[]} names
   */
  prefetch(names) {
    for (const name of names) {
      if (this.#present.has(name) || this.#arriving.has(name)) continue;
      const arriving = this.reply(`${name}.zip`).then(async (reply) => {
        return new Uint8Array(await reply.arrayBuffer());
      });
      arriving.catch(() => {}); // reported to whoever needs it
      this.#arriving.set(name, arriving);
    }
  }

  /**
   * All chunks that running needs: those of a scene or ladder, and what all build on.
   *
   * @param {string[]} names
   */
  toRun(names) {
    return [...(this.hasSnapshot ? [LIBRARY] : []), "numpy", "core", ...names];
  }

  /**
   * The chunks that importing a scene needs. Where a snapshot has the modules already, their files
   * come later, and so does machine code, which frames import.
   *
   * @param {string} scene
   */
  toImport(scene) {
    const names = this.table.scenes[scene] ?? [];
    if (!this.hasSnapshot) return this.toRun(names);
    return names.filter((name) => !this.table.machine_code.includes(name));
  }

  /** @param {string[]} names */
  lacks(names) {
    return !names.every((name) => this.#present.has(name));
  }

  /**
   * Fetch and unpack chunks. One that does not arrive is requested again when it is next needed.
   *
   * @param {string[]} names
   * @throws {LoadError}
   */
  async provide(names) {
    this.prefetch(names);
    for (const name of names) {
      const arriving = this.#arriving.get(name);
      this.#arriving.delete(name);
      const archive = await arriving;
      if (archive) this.#unpack(name, archive);
    }
  }

  /**
   * Fetch and unpack a chunk at once: Python is in the midst of importing from it.
   *
   * @param {string} name
   * @throws {LoadError} Also kept in `missed`, as Python reports an error of its own.
   */
  fetchNow(name) {
    if (this.#present.has(name)) return;
    try {
      this.#unpack(name, loadNow(`${this.url}${name}.zip`));
    } catch (error) {
      this.missed = error instanceof LoadError ? error : new LoadError("other", `${name}.zip`);
      throw this.missed;
    }
  }

  /**
   * @param {string} name
   * @param {Uint8Array} archive
   */
  #unpack(name, archive) {
    if (this.#present.has(name)) return;
    const { FS } = this.pyodide;
    const { folder, library } = this.table;
    if (name === LIBRARY) FS.writeFile(library, archive);
    else if (name === SOURCES) FS.writeFile(`/lib/${name}.zip`, archive);
    else this.pyodide.unpackArchive(archive, "zip", { extractDir: folder });
    this.#present.add(name);
  }
}

/**
 * An archive, by a synchronous request.
 *
 * @param {string} url
 * @returns {Uint8Array}
 * @throws {LoadError}
 */
function loadNow(url) {
  const request = new XMLHttpRequest();
  request.open("GET", url, false);
  request.responseType = "arraybuffer";
  try {
    request.send();
  } catch {
    throw new LoadError("network", url);
  }
  if (request.status !== 200) throw new LoadError("status", url, String(request.status));
  const archive = new Uint8Array(request.response);
  if (archive[0] === "<".charCodeAt(0)) throw new LoadError("page", url);
  return archive;
}
