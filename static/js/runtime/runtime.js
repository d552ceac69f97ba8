/**
 * The page's side of the worker that runs Python.
 *
 * One call is in the worker at a time; the rest wait here, so that the most urgent goes next
 * and a silent worker can be told from a busy one. A worker that does not answer in time is
 * ended and started anew; what waits is kept.
 */

import { all } from "../page/dom.js";
import { recall, remember } from "../page/storage.js";
import { words } from "../page/words.js";
import { findFault } from "./fault.js";
import { LIMITS, Patience } from "./patience.js";
import { Watchdog } from "./watchdog.js";

/** @import { FaultKind, Told } from "./fault.js" */

/**
 * Why a call failed: `python` (our code raised), `start` (no interpreter), `part` (one of its files
 * could not be had), `lost` (no answer).
 */
export class RuntimeFailure extends Error {
  /**
   * @param {"python" | "start" | "part" | "lost"} kind
   * @param {string} message
   * @param {{late?: boolean, fault?: FaultKind}} [more] Whether the time was up; what is wrong with
   *   a file.
   */
  constructor(kind, message, { late = false, fault } = {}) {
    super(message);
    this.kind = kind;
    this.late = late;
    this.fault = fault;
  }
}

/** Of an interpreter that is ended on purpose. */
export function closed() {
  return new RuntimeFailure("lost", words("runtime.closed"));
}

/**
 * What a call carries; `limit` is the longest wait for its answer where the usual one will not do.
 *
 * @typedef {{figure?: string, scene?: string, limit?: number} & Record<string, unknown>} Payload
 */

/**
 * What a figure needs of a runtime.
 *
 * @typedef {Pick<Runtime, "call" | "forget" | "recycle" | "generation">} Caller
 */

/**
 * @typedef {object} Call
 * @property {number} id
 * @property {string} name
 * @property {Payload} payload
 * @property {() => number} urgency Asked when the worker is free: the highest goes first.
 * @property {(reply: any) => void} resolve
 * @property {(reason: RuntimeFailure) => void} reject
 */

/** Under which name the browser keeps which runtime it has started; the page's head reads it. */
const STARTED = "started";

let interpreters = 0;

export class Runtime {
  /** @type {Call[]} */
  #waiting = [];
  /** @type {Call | null} */
  #active = null;
  /** @type {Worker | null} */
  #worker = null;
  #watchdog = new Watchdog();
  #patience = new Patience();
  /** @type {ArrayBuffer[]} Memory of frames that are painted, on its way back to the worker. */
  #spare = [];
  #lastId = 0;
  #failedStarts = 0;
  /** Which interpreter it is: a new one knows nothing of what the last was told. */
  generation = 0;
  /**
   * Scenes that this worker has imported: their first frame takes longer.
   *
   * @type {Set<string>}
   */
  #seen = new Set();
  /**
   * Scenes that this worker has ready to draw, and of which sources they are.
   *
   * @type {Map<string, string>}
   */
  #sources = new Map();

  /**
   * @param {string} url Absolute address of the runtime folder.
   * @param {() => string[]} [scenes] Asked when a worker starts: what it will be asked for.
   * @param {() => Worker | null} [begun] A worker that is on its way already, if there is one.
   */
  constructor(url, scenes = scenesOfPage, begun = () => null) {
    this.url = url;
    this.scenes = scenes;
    this.begun = begun;
  }

  /** Whether this browser can run the interpreter at all. */
  static get supported() {
    return typeof WebAssembly === "object" && typeof Worker === "function";
  }

  /**
   * Answer of the worker to `name`, whenever its turn comes.
   *
   * @param {string} name
   * @param {Payload} payload
   * @param {() => number} [urgency]
   * @returns {Promise<any>}
   */
  call(name, payload, urgency = () => 0) {
    return new Promise((resolve, reject) => {
      this.#waiting.push({ id: ++this.#lastId, name, payload, urgency, resolve, reject });
      this.#next();
    });
  }

  /**
   * Of which sources a scene is that this worker has at hand; nothing where it has not.
   *
   * @param {string} scene
   */
  sourcesOf(scene) {
    return this.#sources.get(scene);
  }

  /**
   * Drop what belongs to a figure that left the page, here and in the worker.
   *
   * @param {string} figure
   */
  forget(figure) {
    const leaving = this.#waiting.filter((call) => call.payload.figure === figure);
    this.#waiting = this.#waiting.filter((call) => !leaving.includes(call));
    for (const call of leaving) call.reject(new RuntimeFailure("lost", words("runtime.gone")));
    // In a task of its own: what the next page's figures ask for meanwhile goes first.
    setTimeout(() => {
      if (this.#worker) this.call("forget", { figure }).catch(() => {});
    });
  }

  /**
   * Give the memory of a frame's pixels back, once they are painted: the next frame is put there.
   *
   * @param {ArrayBuffer[]} rasters
   */
  recycle(rasters) {
    if (this.#worker) this.#spare.push(...rasters);
  }

  /** End the worker; who waits for it hears that it is gone. */
  close() {
    for (const call of this.#waiting.splice(0)) call.reject(closed());
    if (this.#worker) this.#lose(closed().message);
  }

  #next() {
    if (this.#active || this.#waiting.length === 0) return;
    if (!this.#worker) {
      this.#boot();
      return;
    }
    const urgencies = this.#waiting.map((call) => call.urgency());
    const chosen = urgencies.indexOf(Math.max(...urgencies));
    this.#send(this.#waiting.splice(chosen, 1)[0]);
  }

  #boot() {
    const { table } = document.body.dataset;
    this.#seen.clear();
    this.#sources.clear();
    this.generation = ++interpreters;
    const script = new URL("./worker.js", import.meta.url);
    const worker = this.begun() ?? new Worker(script, { type: "module" });
    this.#worker = worker;
    worker.onmessage = (event) => this.#receive(event.data);
    worker.onerror = async (event) => {
      event.preventDefault();
      const { kind, file, detail } = (await findFault(script.href)).told;
      if (this.#worker !== worker) return;
      if (kind === "other") this.#lose(event.message || words("runtime.no_worker"));
      else this.#lose(inWords({ kind, file, detail }), { fault: kind });
    };
    worker.onmessageerror = () => this.#lose(words("runtime.unreadable"));
    this.#send({
      id: ++this.#lastId,
      name: "start",
      payload: {
        url: this.url,
        fresh: this.#failedStarts > 0,
        known: recall(STARTED) === this.url,
        scenes: this.scenes(),
        table,
      },
      urgency: () => 0,
      resolve: ({ importMs }) => {
        this.#failedStarts = 0;
        remember(STARTED, this.url);
        this.#patience.started(importMs);
      },
      reject: (reason) => this.#giveUp(reason),
    });
  }

  /** @param {Call} call */
  #send(call) {
    this.#active = call;
    const { scene, limit } = call.payload;
    const name = scene && !this.#seen.has(scene) ? "first" : call.name;
    if (scene) this.#seen.add(scene);
    this.#watch(limit ?? this.#patience.limit(name, scene));
    const spare = this.#spare.splice(0);
    const message = { id: call.id, call: call.name, ...call.payload, spare };
    this.#worker?.postMessage(message, { transfer: spare });
  }

  /** @param {number} limit */
  #watch(limit) {
    this.#watchdog.watch(limit, () => this.#lose(words("runtime.late"), { late: true }));
  }

  /** @param {any} reply */
  #receive(reply) {
    const call = this.#active;
    if (!call || call.id !== reply.id) return;
    const { scene, limit } = call.payload;
    if ("fetching" in reply) {
      this.#watch(reply.fetching ? LIMITS.start : (limit ?? this.#patience.limit("first", scene)));
      return;
    }
    const message = reply.fault ? inWords(reply.fault) : reply.error;
    const more = { fault: reply.fault?.kind };
    if (!reply.ok && (reply.fatal || call.name === "start")) {
      this.#lose(message, more);
      return;
    }
    this.#settle();
    if (reply.ok) {
      if (scene && reply.sources) this.#sources.set(scene, reply.sources);
      if (scene && reply.computeMs) this.#patience.learn(scene, reply.computeMs);
      call.resolve(reply);
    } else call.reject(new RuntimeFailure(reply.fault ? "part" : "python", message, more));
    this.#next();
  }

  /**
   * The worker is of no more use: end it, tell its caller, and go on with a new one.
   *
   * @param {string} message
   * @param {{late?: boolean, fault?: FaultKind}} [more]
   */
  #lose(message, more) {
    const call = this.#active;
    this.#settle();
    this.#worker?.terminate();
    this.#worker = null;
    this.#spare = [];
    this.#sources.clear();
    call?.reject(new RuntimeFailure(call.name === "start" ? "start" : "lost", message, more));
    this.#next();
  }

  #settle() {
    this.#watchdog.rest();
    this.#active = null;
  }

  /**
   * No interpreter: everyone who waits hears why; the next call tries again.
   *
   * @param {RuntimeFailure} reason
   */
  #giveUp(reason) {
    if (!reason.late) this.#failedStarts += 1; // what has come of a slow download is good
    for (const call of this.#waiting.splice(0)) call.reject(reason);
  }
}

/** @param {Told | {kind: "memory"}} fault */
function inWords(fault) {
  return words(`runtime.${fault.kind}`, fault);
}

/** The scenes that the page will ask for. */
function scenesOfPage() {
  const figures = all(document, "simulation-figure", HTMLElement);
  return [...new Set(figures.map((figure) => figure.dataset.simulation ?? ""))];
}

/**
 * The worker that the page's head has begun, while the page was still being read; null where there is
 * none, or none any more.
 *
 * @returns {Worker | null}
 */
function takeBegun() {
  const page = /** @type {{begunWorker?: Worker}} */ (globalThis);
  const begun = page.begunWorker ?? null;
  delete page.begunWorker;
  return begun;
}

/** @type {Runtime | null} */
let shared = null;

/** The page's only interpreter, or null where the book was built without one. */
export function sharedRuntime() {
  const address = document.body.dataset.runtime;
  if (!shared && address) {
    shared = new Runtime(new URL(address, location.href).href, scenesOfPage, takeBegun);
  }
  return shared;
}
