/**
 * The worker that holds the Python interpreter. Takes `{id, call, ...}`, answers
 * `{id, ok: true, ...}` or `{id, ok: false, error, fatal}`; nothing goes unanswered.
 */

import { message } from "../errors.js";
import { Fault } from "./fault.js";
import { NUMPY, Parts, PYTHON, SIMULATIONS } from "./parts.js";

const SCRIPTS = ["pyodide.mjs", "pyodide.asm.mjs"];
const MACHINE = "pyodide.asm.wasm";

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

/** @typedef {{figure: string, scene: string, values: string, tier: string}} FrameCall */

const calls = {
  /**
   * Start the interpreter from the folder `url`, with a new table if `fresh`, and fetch what `scenes`
   * will import. Every file is known to be whole before any of it runs.
   *
   * @param {{url: string, fresh: boolean, scenes: string[]}} call
   */
  async start({ url, fresh, scenes }) {
    parts = await Parts.listed(url, fresh);
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
    return { reply: { version: pyodide.version, importMs } };
  },

  /**
   * One frame: its description as JSON and the pixels of its panels, handed over.
   *
   * @param {FrameCall} call
   */
  async render({ figure, scene, values, tier }) {
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
    const met = python.judge(figure, scene, values, tier, JSON.stringify(conditions));
    return { reply: { met: met ?? null } };
  },

  /**
   * A script that prints what a frame of these values says, of the book's code and picture.
   *
   * @param {FrameCall & {told: string}} call `told`: JSON of the paragraphs that it begins with.
   */
  async script({ scene, values, tier, told }) {
    return { reply: { script: python.script(scene, values, tier, told) } };
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
    await provideFor(data);
    const { reply, transfer = [] } = await answer(data);
    self.postMessage({ id: data.id, ok: true, ...reply }, { transfer });
  } catch (error) {
    self.postMessage({ id: data.id, ok: false, ...explain(error) });
  }
};

/**
 * Have in place what a call's scene or ladder imports. The page is told when that has to be waited
 * for, since a network may be slow where the machine is not.
 *
 * @param {{id: number, scene?: string, ladder?: string}} call
 */
async function provideFor({ id, scene = "", ladder = "" }) {
  const names = parts?.table.scenes[scene] ?? parts?.table.ladders[ladder] ?? [];
  if (!parts?.lacks(names)) return;
  self.postMessage({ id, fetching: true });
  await parts.provide(names);
  self.postMessage({ id, fetching: false });
}

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
    return view.data.slice().buffer;
  } finally {
    view.release();
    array.destroy();
  }
}

/**
 * A Python exception leaves the interpreter sound, and so does a file that cannot be had; anything
 * else does not. Of memory there is no more to be had before there is a new interpreter.
 *
 * @param {unknown} error
 */
function explain(error) {
  const text = message(error).trim();
  if (error instanceof Fault) return { error: text, fault: error.told, fatal: false };
  const raised = error instanceof Error && error.name === "PythonError";
  const last = raised ? lastException(text) : text;
  if (/MemoryError\b|^Array buffer allocation failed/.test(last)) {
    return { error: last, fault: { kind: "memory" }, fatal: true };
  }
  return { error: last, fatal: !raised };
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
