/**
 * The worker that holds the Python interpreter. Takes `{id, call, ...}`, answers
 * `{id, ok: true, ...}` or `{id, ok: false, error, fatal}`; nothing goes unanswered.
 */

/** Pyodide's own files; `runtime.json` names the rest. */
const CORE_FILES = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm"];
/** What the interpreter starts with; `numpy.zip` holds machine code, which must be unpacked. */
const PYTHON = "python.zip";
const NUMPY = "numpy.zip";
const SIMULATIONS = "simulations.zip";

/** @type {any} Proxies of `simulations.browser`, held for the life of the worker. */
let python = null;
/** @type {Parts} */
let parts;

const calls = {
  /**
   * Start the interpreter from the folder `url`, past the HTTP cache if `fresh`, and fetch what
   * `scenes` will import.
   */
  async start({ url, fresh, scenes }) {
    if (fresh) await refetch(url);
    const [table, { loadPyodide }] = await Promise.all([
      fetch(`${url}runtime.json`).then(read("json")),
      import(/* @vite-ignore */ `${url}pyodide.mjs`),
    ]);
    parts = new Parts(url, table);
    const [numpy, simulations] = [parts.fetch(NUMPY), parts.fetch(SIMULATIONS)];
    for (const scene of scenes) parts.expect(table.scenes[scene]);
    const options = {
      indexURL: url,
      stdLibURL: url + PYTHON,
      lockFileContents: JSON.stringify(table.lock),
    };
    const pyodide = await Promise.race([loadPyodide(options), webAssemblyFailure()]);
    parts.unpackInto(pyodide);
    parts.unpack(await numpy);
    pyodide.FS.writeFile(`/lib/${SIMULATIONS}`, await simulations);
    pyodide.pyimport("sys").path.append(`/lib/${SIMULATIONS}`);
    const module = pyodide.pyimport("simulations.browser");
    const { render, error, forget, measure, fetch_missing: fetchMissing } = module;
    fetchMissing(JSON.stringify(table.modules), (part) => parts.fetchNow(part), parts.folder);
    python = { render, error, forget, measure };
    return { reply: { version: pyodide.version } };
  },

  /** One frame: its description as JSON and the pixels of its panels, handed over. */
  async render({ figure, scene, values, tier }) {
    await parts.provide(parts.table.scenes[scene]);
    const begun = performance.now();
    const frame = python.render(figure, scene, values, tier);
    try {
      const rasters = takeRasters(frame);
      const meta = frame.meta;
      return {
        reply: { meta, rasters, computeMs: performance.now() - begun },
        transfer: rasters,
      };
    } finally {
      frame.destroy();
    }
  },

  /** The next estimate of a frame's error, as a readout; null where there is no better one. */
  error({ figure, scene, values, tier }) {
    return { reply: { estimate: JSON.parse(python.error(figure, scene, values, tier)) } };
  },

  forget({ figure }) {
    python.forget(figure);
    return { reply: {} };
  },

  /** Time and error of one tier of a ladder, on this machine. */
  async measure({ ladder, tier, budget = 0.4 }) {
    await parts.provide(parts.table.ladders[ladder]);
    return { reply: { result: python.measure(ladder, tier, budget) } };
  },
};

self.onmessage = async ({ data }) => {
  try {
    const { reply, transfer = [] } = await calls[data.call](data);
    self.postMessage({ id: data.id, ok: true, ...reply }, transfer);
  } catch (error) {
    self.postMessage({ id: data.id, ok: false, ...explain(error) });
  }
};

/**
 * Parts of Python's library and of numpy, beyond those that every scene needs. What the scenes of
 * the page import is fetched while the interpreter starts; anything else when Python asks for it.
 */
class Parts {
  /** @type {Map<string, Promise<Uint8Array>>} */
  #coming = new Map();
  #here = new Set();
  #damaged = new Set();
  /** @type {any} */
  #pyodide = null;

  constructor(/** @type {string} */ url, table) {
    this.url = url;
    this.table = table;
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

  unpackInto(pyodide) {
    this.#pyodide = pyodide;
    const site = pyodide.pyimport("site");
    this.folder = site.getsitepackages().get(0);
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

/** Copies of the pixels, out of the interpreter's memory. @returns {ArrayBuffer[]} */
function takeRasters(frame) {
  const rasters = frame.rasters;
  try {
    return Array.from({ length: rasters.length }, (_, index) => takeRaster(rasters.get(index)));
  } finally {
    rasters.destroy();
  }
}

/** @returns {ArrayBuffer} */
function takeRaster(array) {
  const view = array.getBuffer("u8");
  try {
    return view.data.slice().buffer;
  } finally {
    view.release();
    array.destroy();
  }
}

/** A Python exception leaves the interpreter sound; anything else does not. */
function explain(error) {
  const message = String(error?.message ?? error).trim();
  const raised = error?.name === "PythonError";
  return { error: raised ? lastException(message) : message, fatal: !raised };
}

/** The line of a traceback that names the exception; what it says may run on below. */
function lastException(/** @type {string} */ traceback) {
  const named = traceback.split("\n").filter((line) => /^[\w.]+(:|$)/.test(line));
  return named.at(-1) ?? traceback;
}

/**
 * Rejects if the interpreter's WebAssembly cannot be had: Pyodide itself would only warn, and
 * wait for ever. A host that sends it with another type than `application/wasm` is served too.
 * @returns {Promise<never>}
 */
function webAssemblyFailure() {
  return new Promise((_, reject) => {
    const streaming = WebAssembly.instantiateStreaming;
    WebAssembly.instantiateStreaming = async (source, imports) => {
      try {
        const response = await source;
        if (!response.ok) throw new Error(`${response.url}: ${response.status}`);
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

/** Replace what the HTTP cache holds: a damaged file must not come back on a second try. */
async function refetch(url) {
  const reload = (name) => fetch(url + name, { cache: "reload" });
  const names = [...CORE_FILES, PYTHON, NUMPY, SIMULATIONS, "runtime.json"];
  await Promise.all(names.map(reload));
}
