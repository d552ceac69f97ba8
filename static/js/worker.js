/**
 * The worker that holds the Python interpreter. Takes `{id, call, ...}`, answers
 * `{id, ok: true, ...}` or `{id, ok: false, error, fatal}`; nothing goes unanswered.
 */

/** Pyodide's own files, in the order it asks for them; the lock file names the packages. */
const CORE_FILES = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip"];
const LOCK_FILE = "pyodide-lock.json";

/** @type {any} Proxies of `simulations.browser`, held for the life of the worker. */
let python = null;

const calls = {
  /** Start the interpreter from the folder `url`, past the HTTP cache if `fresh`. */
  async start({ url, fresh }) {
    if (fresh) await refetch(url);
    const { loadPyodide } = await import(/* @vite-ignore */ `${url}pyodide.mjs`);
    const options = { indexURL: url, packageBaseUrl: url, packages: ["simulations"] };
    const pyodide = await Promise.race([loadPyodide(options), webAssemblyFailure()]);
    const module = pyodide.pyimport("simulations.browser");
    const { render, error, forget, measure } = module;
    python = { render, error, forget, measure };
    return { reply: { version: pyodide.version } };
  },

  /** One frame: its description as JSON and the pixels of its panels, handed over. */
  render({ figure, scene, values, tier }) {
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
  measure({ ladder, tier, budget = 0.4 }) {
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
  const lock = await (await reload(LOCK_FILE)).json();
  const packages = Object.values(lock.packages).map((entry) => entry.file_name);
  await Promise.all([...CORE_FILES, ...packages].map(reload));
}
