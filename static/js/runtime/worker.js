/**
 * The worker that holds the Python interpreter. Takes `{id, call, ...}`, answers
 * `{id, ok: true, ...}` or `{id, ok: false, error, fatal}`; nothing goes unanswered.
 */

import { message } from "../errors.js";
import { NUMPY, Parts, PYTHON, SIMULATIONS, TABLE } from "./parts.js";

const PYODIDE = ["pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm"];

/**
 * Proxies of `simulations.browser`, held for the life of the worker.
 *
 * @type {any}
 */
let python = null;
/**
 * What there is to load.
 *
 * @type {Parts}
 */
let parts;
/**
 * Memory of frames that the page has painted: the next pixels of that size are put there.
 *
 * @type {ArrayBuffer[]}
 */
let spare = [];
/** As many as a page that paints frames of two figures in turn. */
const MOST_SPARE = 8;

/** @typedef {{figure: string, scene: string, values: string, tier: string}} FrameCall */

const calls = {
  /**
   * Start the interpreter from the folder `url`, past the HTTP cache if `fresh`, and fetch what
   * `scenes` will import.
   *
   * @param {{url: string, fresh: boolean, scenes: string[]}} call
   */
  async start({ url, fresh, scenes }) {
    if (fresh) await refetch(url);
    const pyodideScript = import(`${url}pyodide.mjs`);
    parts = await Parts.listed(url);
    const { table } = parts;
    const [numpy, simulations] = [parts.fetch(NUMPY), parts.fetch(SIMULATIONS)];
    for (const scene of scenes) parts.expect(table.scenes[scene]);
    const options = {
      indexURL: url,
      stdLibURL: url + PYTHON,
      lockFileContents: JSON.stringify(table.lock),
    };
    const { loadPyodide } = await pyodideScript;
    const pyodide = await Promise.race([loadPyodide(options), webAssemblyFailure()]);
    parts.pyodide = pyodide;
    parts.unpack(await numpy); // its machine code cannot be loaded from within an archive
    pyodide.FS.writeFile(`/lib/${SIMULATIONS}`, await simulations);
    pyodide.pyimport("sys").path.append(`/lib/${SIMULATIONS}`);
    const module = pyodide.pyimport("simulations.browser");
    const {
      render,
      render_edited: renderEdited,
      pull,
      error,
      photograph,
      forget,
      judge,
      measure,
      script,
    } = module;
    const fetchNow = (/** @type {string} */ part) => parts.fetchNow(part);
    module.fetch_missing(JSON.stringify(table.modules), fetchNow, parts.folder);
    python = { render, renderEdited, pull, error, photograph, forget, judge, measure, script };
    return { reply: { version: pyodide.version } };
  },

  /**
   * One frame: its description as JSON and the pixels of its panels, handed over.
   *
   * @param {FrameCall} call
   */
  async render({ figure, scene, values, tier }) {
    await parts.provide(parts.table.scenes[scene]);
    const begun = performance.now();
    const { meta, rasters } = takeFrame(python.render(figure, scene, values, tier));
    const computeMs = performance.now() - begun;
    return { reply: { meta, rasters, computeMs }, transfer: rasters };
  },

  /**
   * One frame by the reader's own code, as `render`; or what went wrong in it. With what it printed.
   *
   * @param {FrameCall & {edits: string}} call
   */
  async renderEdited({ figure, scene, values, tier, edits }) {
    await parts.provide(parts.table.scenes[scene]);
    const begun = performance.now();
    const answer = python.renderEdited(figure, scene, values, tier, edits);
    try {
      const { problem, printed, frame } = answer;
      const told = { problem: JSON.parse(problem), printed };
      if (!frame) return { reply: told };
      const { meta, rasters } = takeFrame(frame);
      const computeMs = performance.now() - begun;
      return { reply: { ...told, meta, rasters, computeMs }, transfer: rasters };
    } finally {
      answer.destroy();
    }
  },

  /**
   * The control values that bring a handle to a place of its panel.
   *
   * @param {{scene: string, values: string, tier: string, handle: string, x: number,
   *   y: number}} call
   */
  async pull({ scene, values, tier, handle, x, y }) {
    await parts.provide(parts.table.scenes[scene]);
    return { reply: { values: JSON.parse(python.pull(scene, values, tier, handle, x, y)) } };
  },

  /**
   * The next estimate of a frame's error, as a readout; null where there is no better one.
   *
   * @param {FrameCall & {edits?: string}} call
   */
  error({ figure, scene, values, tier, edits = "" }) {
    return { reply: { estimate: JSON.parse(python.error(figure, scene, values, tier, edits)) } };
  },

  /**
   * The place of the first condition that holds of a figure's state; null where none does.
   *
   * @param {FrameCall & {conditions: string[]}} call
   */
  async judge({ figure, scene, values, tier, conditions }) {
    await parts.provide(parts.table.scenes[scene]);
    const met = python.judge(figure, scene, values, tier, JSON.stringify(conditions));
    return { reply: { met: met ?? null } };
  },

  /**
   * A script that prints what a frame of these values says, of the book's code and picture.
   *
   * @param {FrameCall & {edited: boolean, own: boolean}} call
   */
  async script({ scene, values, tier, edited, own }) {
    await parts.provide(parts.table.scenes[scene]);
    return { reply: { script: python.script(scene, values, tier, edited, own) } };
  },

  /**
   * The reader's own picture for a figure: the bytes of a canvas, or nothing for the book's again.
   *
   * @param {{figure: string, number: number, pixels?: Uint8ClampedArray, width: number,
   *   height: number}} call
   */
  photograph({ figure, number, pixels, width, height }) {
    python.photograph(figure, number, pixels, width, height);
    return { reply: {} };
  },

  /** @param {{figure: string}} call */
  forget({ figure }) {
    python.forget(figure);
    return { reply: {} };
  },

  /**
   * Time and error of one tier of a ladder, on this machine.
   *
   * @param {{ladder: string, tier: string, budget: number}} call
   */
  async measure({ ladder, tier, budget }) {
    await parts.provide(parts.table.ladders[ladder]);
    return { reply: { result: python.measure(ladder, tier, budget) } };
  },
};

/**
 * @param {{id: number, call: keyof typeof calls} & Record<string, any>} request
 * @returns {Promise<{reply: object, transfer?: Transferable[]}>}
 */
async function answer(request) {
  /** @type {(request: any) => any} */
  const call = calls[request.call];
  return await call(request);
}

self.onmessage = async ({ data }) => {
  try {
    spare = [...(data.spare ?? []), ...spare].slice(0, MOST_SPARE);
    const { reply, transfer = [] } = await answer(data);
    self.postMessage({ id: data.id, ok: true, ...reply }, { transfer });
  } catch (error) {
    self.postMessage({ id: data.id, ok: false, ...explain(error) });
  }
};

/**
 * What a frame holds, copied out of the interpreter's memory; the frame itself is let go.
 *
 * @param {any} frame
 * @returns {{meta: string, rasters: ArrayBuffer[]}}
 */
function takeFrame(frame) {
  try {
    return { meta: frame.meta, rasters: takeRasters(frame) };
  } finally {
    frame.destroy();
  }
}

/**
 * Copies of the pixels, out of the interpreter's memory.
 *
 * @param {any} frame
 * @returns {ArrayBuffer[]}
 */
function takeRasters(frame) {
  const rasters = frame.rasters;
  try {
    return Array.from({ length: rasters.length }, (_, index) => takeRaster(rasters.get(index)));
  } finally {
    rasters.destroy();
  }
}

/**
 * @param {any} array
 * @returns {ArrayBuffer}
 */
function takeRaster(array) {
  const view = array.getBuffer("u8");
  try {
    const index = spare.findIndex(({ byteLength }) => byteLength === view.data.length);
    if (index < 0) return view.data.slice().buffer;
    const [pixels] = spare.splice(index, 1);
    new Uint8Array(pixels).set(view.data);
    return pixels;
  } finally {
    view.release();
    array.destroy();
  }
}

/**
 * A Python exception leaves the interpreter sound; anything else does not.
 *
 * @param {unknown} error
 */
function explain(error) {
  const text = message(error).trim();
  const raised = error instanceof Error && error.name === "PythonError";
  return { error: raised ? lastException(text) : text, fatal: !raised };
}

/**
 * The line of a traceback that names the exception; what it says may run on below.
 *
 * @param {string} traceback
 */
function lastException(traceback) {
  const named = traceback.split("\n").filter((line) => /^[\w.]+(:|$)/.test(line));
  return named.at(-1) ?? traceback;
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

/**
 * Replace what the HTTP cache holds: a damaged file must not come back on a second try.
 *
 * @param {string} url
 */
async function refetch(url) {
  const names = [...PYODIDE, PYTHON, NUMPY, SIMULATIONS, TABLE];
  await Promise.all(names.map((name) => fetch(url + name, { cache: "reload" })));
}
