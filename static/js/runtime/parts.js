/**
 * What the worker loads beside the interpreter: the simulations, and Python's library and numpy in
 * parts, as `runtime.json` lists them. What the scenes of the page import is fetched while the
 * interpreter starts; anything else when Python asks for it.
 */

/** What the interpreter starts with; the other parts wait until something imports from them. */
export const PYTHON = "python.zip";
export const NUMPY = "numpy.zip";
export const SIMULATIONS = "simulations.zip";
export const TABLE = "runtime.json";

export class Parts {
  /** @type {Map<string, Promise<Uint8Array>>} */
  #coming = new Map();
  #here = new Set();
  #damaged = new Set();
  /** @type {any} */
  #pyodide = null;

  /** @param {string} url The runtime's folder. @param {any} table What `runtime.json` says. */
  constructor(url, table) {
    this.url = url;
    this.table = table;
  }

  /** @returns {Promise<Parts>} */
  static async listed(/** @type {string} */ url) {
    return new Parts(url, await read("json")(await fetch(url + TABLE)));
  }

  /** Where parts are unpacked from now on. */
  set pyodide(pyodide) {
    this.#pyodide = pyodide;
    this.folder = pyodide.pyimport("site").getsitepackages().get(0);
  }

  /** @returns {Promise<Uint8Array>} The file, if it is whole. */
  async fetch(/** @type {string} */ name) {
    const cache = this.#damaged.has(name) ? "reload" : "default";
    try {
      const reply = await fetch(this.url + name, { cache, integrity: this.table.integrity[name] });
      return new Uint8Array(await read("arrayBuffer")(reply));
    } catch (error) {
      this.#damaged.add(name);
      throw new Error(`${name}: ${error.message}`);
    }
  }

  /** Begin to fetch parts. */
  expect(/** @type {string[]} */ names = []) {
    for (const name of names) {
      if (this.#here.has(name) || this.#coming.has(name)) continue;
      const coming = this.fetch(`${name}.zip`);
      coming.catch(() => {}); // told to whoever provides it
      this.#coming.set(name, coming);
    }
  }

  /** Have parts in place; one that cannot be had is asked for again by whoever imports it. */
  async provide(/** @type {string[]} */ names = []) {
    this.expect(names);
    for (const name of names) {
      const coming = this.#coming.get(name);
      const archive = await coming?.catch(() => null);
      this.#coming.delete(name);
      if (archive && !this.#here.has(name)) this.#place(name, archive);
    }
  }

  /** Have a part in place at once: Python is in the midst of importing from it. */
  fetchNow(/** @type {string} */ name) {
    if (this.#here.has(name)) return;
    const request = new XMLHttpRequest();
    request.open("GET", `${this.url}${name}.zip`, false);
    request.responseType = "arraybuffer";
    request.send();
    if (request.status !== 200) throw new Error(`${request.responseURL}: ${request.status}`);
    this.#place(name, new Uint8Array(request.response));
  }

  unpack(/** @type {Uint8Array} */ archive) {
    this.#pyodide.unpackArchive(archive, "zip", { extractDir: this.folder });
  }

  #place(/** @type {string} */ name, /** @type {Uint8Array} */ archive) {
    this.unpack(archive);
    this.#here.add(name);
  }
}

/** @returns {(reply: Response) => Promise<any>} The body of a reply, which must be a good one. */
function read(/** @type {"json" | "arrayBuffer"} */ kind) {
  return (reply) => {
    if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
    return reply[kind]();
  };
}
