/** The worker that runs the Python interpreter; `messages.ts` lists its calls. Every call is answered. */

import { message } from "../errors.ts";
import { SOURCES, type Chunks } from "./chunks.ts";
import { free } from "./free.ts";
import { startInterpreter } from "./interpreter.ts";
import { LoadError } from "./load_error.ts";
import type { CallName, FrameReply, Picture, Replies, Requests } from "./messages.ts";
import { draw } from "./pixels.ts";

/** Functions of `simulations.browser`. */
let python: any = null;
let chunks: Chunks | null = null;
let starting: ReturnType<typeof startInterpreter> | null = null;

const CALLS: {
  [name in CallName]: (request: Requests[name] & { id: number }) => Promise<Replies[name]>;
} = {
  async start(request) {
    starting ??= startInterpreter(request);
    const { python: module, ...started } = await starting;
    chunks = started.chunks;
    python ??= functionsOf(module);
    return {};
  },

  async prepare({ id, scene }) {
    const { table } = started();
    try {
      python.prepare(scene);
    } catch (error) {
      // A snapshot has modules without their files; what the scene imports may be one of these.
      const names = started().toRun(table.scenes[scene] ?? []);
      if (!started().lacks(names)) throw error;
      await provide(id, names);
      python.prepare(scene);
    }
    return { sources: table.integrity[`${SOURCES}.zip`] };
  },

  async render({ figure, scene, values, tier }) {
    const begun = performance.now();
    const frame = takeFrame(python.render(figure, scene, values, tier));
    started().prefetch(started().later.splice(0));
    return { ...frame, computeMs: performance.now() - begun };
  },

  async renderEdited({ figure, scene, values, tier, edits }) {
    const begun = performance.now();
    const answer = python.render_edited(figure, scene, values, tier, edits);
    try {
      const { problem, printed, frame } = answer;
      const taken = frame ? takeFrame(frame) : { meta: "", rasters: [] };
      const computeMs = performance.now() - begun;
      return { ...taken, computeMs, problem: JSON.parse(problem), printed };
    } finally {
      answer.destroy();
    }
  },

  async pull({ figure, scene, values, tier, handle, x, y }) {
    return { values: JSON.parse(python.pull(figure, scene, values, tier, handle, x, y)) };
  },

  async error({ figure, scene, values, tier, edits = "" }) {
    return { estimate: JSON.parse(python.error(figure, scene, values, tier, edits)) };
  },

  async judge({ figure, scene, values, tier, conditions }) {
    const met = python.judge(figure, scene, values, tier, JSON.stringify(conditions));
    return { met: met ?? null };
  },

  async script({ scene, values, tier, notes }) {
    return { script: python.script(scene, values, tier, notes) };
  },

  async photograph({ figure, picture }) {
    python.photograph(figure, picture ? drawable(picture) : undefined); // which is None
    return {};
  },

  async readings({ figure, readings }) {
    python.readings(figure, JSON.stringify(readings));
    return {};
  },

  async read({ scene, picture }) {
    return JSON.parse(python.read(scene, drawable(picture)));
  },

  async exportFile({ figure, scene, values, tier, name }) {
    return { text: python.export(figure, scene, values, tier, name) };
  },

  async develop({ figure, scene, values, tier, picture }) {
    const raster = python.develop(figure, scene, values, tier, drawable(picture));
    return { rasters: [takeArray(raster)] };
  },

  async sheet({ figure, scene, values, tier }) {
    return JSON.parse(python.sheet(figure, scene, values, tier));
  },

  async forget({ figure }) {
    python.forget(figure);
    return {};
  },

  async measure({ ladder, tier, budget }) {
    return { result: python.measure(ladder, tier, budget) };
  },
};

self.onmessage = async ({ data }) => {
  const { id } = data;
  try {
    if (chunks && data.call !== "start") await provideFor(data, chunks);
    const call: (request: any) => Promise<{}> = CALLS[data.call as CallName];
    const reply = await call(data);
    const { rasters = [], sound = [] } = reply as { rasters?: ArrayBuffer[]; sound?: ArrayBuffer };
    const transfer = rasters.concat(sound);
    self.postMessage({ id, ok: true, ...reply }, { transfer });
  } catch (error) {
    self.postMessage({ id, ok: false, ...explain(error) });
  } finally {
    if (data.picture?.mosaic) free(data.picture.mosaic.codes);
  }
};

function started(): Chunks {
  if (!chunks) throw new Error("the interpreter has not started");
  return chunks;
}

/** Fetch what a call's scene or ladder imports. */
async function provideFor(
  {
    id,
    call,
    scene = "",
    ladder = "",
    edits,
  }: { id: number; call: string; scene?: string; ladder?: string; edits?: string },
  chunks: Chunks,
) {
  chunks.missed = null;
  const { scenes, ladders } = chunks.table;
  const imported = scenes[scene] ?? ladders[ladder] ?? [];
  const wanted = edits === undefined ? imported : [...imported, SOURCES];
  await provide(id, call === "prepare" ? chunks.toImport(scene) : chunks.toRun(wanted));
}

/** @param id Of the call: the page is told when it waits for a download. */
async function provide(id: number, names: string[]) {
  if (!started().lacks(names)) return;
  self.postMessage({ id, fetching: true });
  await started().provide(names);
  self.postMessage({ id, fetching: false });
}

/**
 * One proxy of each function for good, instead of a new one with each call.
 *
 * @param module `simulations.browser`.
 */
function functionsOf(module: any) {
  const { prepare, render, render_edited, pull, error, judge, script } = module;
  const { photograph, readings, read, develop, sheet, forget, measure } = module;
  return {
    prepare,
    render,
    render_edited,
    pull,
    error,
    judge,
    script,
    photograph,
    readings,
    read,
    export: module.export,
    develop,
    sheet,
    forget,
    measure,
  };
}

/** A picture that Python has drawn into an array of its own: there is no room for it twice. */
function drawable({ bitmap, ...about }: Picture) {
  return {
    ...about,
    draw(array: any) {
      const view = array.getBuffer("u8");
      try {
        draw(bitmap, view.data, about.width, about.height);
      } finally {
        view.release();
        bitmap.close();
      }
    },
  };
}

/** A frame, copied out of the interpreter's memory and released there. */
function takeFrame(frame: any): Omit<FrameReply, "computeMs"> {
  const { meta, rasters, sound } = frame;
  try {
    const indices = Array.from({ length: rasters.length }, (_, index) => index);
    const taken = { meta, rasters: indices.map((index) => takeArray(rasters.get(index))) };
    return sound ? { ...taken, sound: takeArray(sound) } : taken;
  } finally {
    rasters.destroy();
    frame.destroy();
  }
}

/** The bytes of an array. */
function takeArray(array: any): ArrayBuffer {
  const view = array.getBuffer("u8");
  try {
    return view.data.slice().buffer;
  } finally {
    view.release();
    array.destroy();
  }
}

/** Of an exception whose message is a sentence for the reader. */
const UNFIT = /^simulations\.engine\.reading\.UnfitError: /;

/**
 * A Python exception leaves the interpreter intact, and so does a file that does not arrive; anything
 * else does not, and exhausted memory needs a new interpreter.
 */
function explain(error: unknown) {
  const raised = error instanceof Error && error.name === "PythonError";
  const missed = raised ? chunks?.missed : error;
  const text = message(error).trim();
  if (missed instanceof LoadError) return { error: text, loadError: missed.data, fatal: false };
  const last = raised ? lastException(text) : text;
  if (/MemoryError\b|^Array buffer allocation failed/.test(last)) {
    return { error: last, loadError: { kind: "memory" }, fatal: true };
  }
  return { error: last.replace(UNFIT, ""), fatal: !raised };
}

/** The line of a traceback that names the exception, with what follows it. */
function lastException(traceback: string) {
  const named = traceback.split("\n").filter((line) => /^[\w.]+(:|$)/.test(line));
  return named.at(-1) ?? traceback;
}
