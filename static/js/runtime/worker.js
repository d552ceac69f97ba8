/**
 * The worker that holds the Python interpreter. Takes `{id, call, ...}`, answers
 * `{id, ok: true, ...}` or `{id, ok: false, error, fatal}`; nothing goes unanswered.
 */

import { message } from "../errors.js";
import { Fault } from "./fault.js";
import { startInterpreter } from "./interpreter.js";
import { SOURCES } from "./parts.js";

/** @import { Started, Wanted } from "./interpreter.js" */
/** @import { Parts } from "./parts.js" */

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
 * The interpreter on its way.
 *
 * @type {Promise<Started> | null}
 */
let starting = null;
/**
 * Memory of frames that the page has painted: the next pixels of that size are put there.
 *
 * @type {ArrayBuffer[]}
 */
let spare = [];
/** As many as a page that paints frames of two figures in turn. */
const MOST_SPARE = 8;
/** Milliseconds after the start in which the first figures are drawn. */
const JUDGE_MS = 5000;
/**
 * What has been found wrong with what the interpreter was made of: it is to be used no more.
 *
 * @type {unknown}
 */
let unsound = null;

/** @typedef {{figure: string, scene: string, values: string, tier: string}} FrameCall */

const calls = {
  /**
   * Begin to start, before anyone needs it: what goes wrong is told to who calls `start`.
   *
   * @param {Wanted} call
   */
  begin(call) {
    starting = startInterpreter(call);
    starting.catch(() => {});
    return { reply: {} };
  },

  /**
   * Start the interpreter, unless it is on its way.
   *
   * @param {Wanted} call
   */
  async start(call) {
    starting ??= startInterpreter(call);
    const { version, importMs, judge, ...started } = await starting;
    ({ parts, python } = started);
    setTimeout(() => judge().catch((error) => (unsound = error)), JUDGE_MS);
    return { reply: { version, importMs } };
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
   * Have a scene ready to draw, and tell of which sources it is. What it imports that nobody has
   * foreseen may lie in files that a memory does without.
   *
   * @param {{id: number, scene: string}} call
   */
  async prepare({ id, scene }) {
    try {
      python.prepare(scene);
    } catch (error) {
      const names = parts.toRun(parts.table.scenes[scene]);
      if (!parts.lacks(names)) throw error;
      await provide(id, names);
      python.prepare(scene);
    }
    return { reply: { sources: parts.table.integrity[`${SOURCES}.zip`] } };
  },

  /**
   * Have the stages of a frame at hand: of a figure, or, where that is empty, of the first that will
   * show the scene.
   *
   * @param {FrameCall} call
   */
  warm({ figure, scene, values, tier }) {
    python.warm(figure, scene, values, tier);
    return { reply: {} };
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
    if (unsound) throw unsound;
    if (parts) parts.missed = null;
    await provideFor(data);
    spare = [...(data.spare ?? []), ...spare].slice(0, MOST_SPARE);
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
 * @param {{id: number, call: string, scene?: string, ladder?: string, edits?: string}} asked
 */
async function provideFor({ id, call, scene = "", ladder = "", edits }) {
  if (!parts) return;
  if (call === "prepare") return provide(id, parts.toImport(scene));
  const imported = parts.table.scenes[scene] ?? parts.table.ladders[ladder] ?? [];
  await provide(id, parts.toRun(edits === undefined ? imported : [...imported, SOURCES]));
}

/**
 * @param {number} id Of the call.
 * @param {string[]} names
 */
async function provide(id, names) {
  if (!parts.lacks(names)) return;
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
 * A Python exception leaves the interpreter sound, and so does a file that cannot be had; anything
 * else does not. Of memory there is no more to be had before there is a new interpreter.
 *
 * @param {unknown} error
 */
function explain(error) {
  const raised = error instanceof Error && error.name === "PythonError";
  const missed = raised ? parts?.missed : error;
  const text = message(error).trim();
  const fatal = error === unsound;
  if (missed instanceof Fault) return { error: text, fault: missed.told, fatal };
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
