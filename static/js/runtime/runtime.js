/**
 * The page's side of the worker that runs Python.
 *
 * One call is in the worker at a time; the rest wait here, so that the most urgent goes next
 * and a silent worker can be told from a busy one. A worker that does not answer in time is
 * ended and started anew; what waits is kept.
 */

import { all } from "../page/dom.js";
import { words } from "../page/words.js";

/**
 * Longest wait for an answer in milliseconds. Starting may include a slow download.
 *
 * @type {Record<string, number>}
 */
export const LIMITS = {
  start: 300_000,
  first: 30_000,
  render: 10_000,
  pull: 10_000,
  photograph: 10_000,
  error: 10_000,
  judge: 10_000,
  forget: 10_000,
  script: 10_000,
  measure: 120_000,
};

/** Why a call failed: `python` (our code raised), `start` (no interpreter), `lost` (no answer). */
export class RuntimeFailure extends Error {
  /**
   * @param {"python" | "start" | "lost"} kind
   * @param {string} message
   * @param {boolean} [late] Whether the time was up.
   */
  constructor(kind, message, late = false) {
    super(message);
    this.kind = kind;
    this.late = late;
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

let interpreters = 0;

export class Runtime {
  /** @type {Call[]} */
  #waiting = [];
  /** @type {Call | null} */
  #active = null;
  /** @type {Worker | null} */
  #worker = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #watchdog;
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
   * @param {string} url Absolute address of the runtime folder.
   * @param {() => string[]} [scenes] Asked when a worker starts: what it will be asked for.
   */
  constructor(url, scenes = scenesOfPage) {
    this.url = url;
    this.scenes = scenes;
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
   * Drop what belongs to a figure that left the page, here and in the worker.
   *
   * @param {string} figure
   */
  forget(figure) {
    const leaving = this.#waiting.filter((call) => call.payload.figure === figure);
    this.#waiting = this.#waiting.filter((call) => !leaving.includes(call));
    for (const call of leaving) call.reject(new RuntimeFailure("lost", words("runtime.gone")));
    if (this.#worker) this.call("forget", { figure }).catch(() => {});
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
    this.#seen.clear();
    this.generation = ++interpreters;
    this.#worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.#worker.onmessage = (event) => this.#receive(event.data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#lose(event.message || words("runtime.no_worker"));
    };
    this.#worker.onmessageerror = () => this.#lose(words("runtime.unreadable"));
    this.#send({
      id: ++this.#lastId,
      name: "start",
      payload: { url: this.url, fresh: this.#failedStarts > 0, scenes: this.scenes() },
      urgency: () => 0,
      resolve: () => (this.#failedStarts = 0),
      reject: (reason) => this.#giveUp(reason),
    });
  }

  /** @param {Call} call */
  #send(call) {
    this.#active = call;
    const { scene, limit: given } = call.payload;
    const limit = given ?? (scene && !this.#seen.has(scene) ? LIMITS.first : LIMITS[call.name]);
    if (scene) this.#seen.add(scene);
    this.#watchdog = setTimeout(() => this.#lose(words("runtime.late"), true), limit);
    const spare = this.#spare.splice(0);
    const message = { id: call.id, call: call.name, ...call.payload, spare };
    this.#worker?.postMessage(message, { transfer: spare });
  }

  /** @param {any} reply */
  #receive(reply) {
    const call = this.#active;
    if (!call || call.id !== reply.id) return;
    if (!reply.ok && (reply.fatal || call.name === "start")) {
      this.#lose(reply.error);
      return;
    }
    this.#settle();
    if (reply.ok) call.resolve(reply);
    else call.reject(new RuntimeFailure("python", reply.error));
    this.#next();
  }

  /**
   * The worker is of no more use: end it, tell its caller, and go on with a new one.
   *
   * @param {string} message
   * @param {boolean} [late]
   */
  #lose(message, late = false) {
    const call = this.#active;
    this.#settle();
    this.#worker?.terminate();
    this.#worker = null;
    this.#spare = [];
    call?.reject(new RuntimeFailure(call.name === "start" ? "start" : "lost", message, late));
    this.#next();
  }

  #settle() {
    clearTimeout(this.#watchdog);
    this.#active = null;
  }

  /**
   * No interpreter: everyone who waits hears why; the next call tries again.
   *
   * @param {RuntimeFailure} reason
   */
  #giveUp(reason) {
    this.#failedStarts += 1;
    for (const call of this.#waiting.splice(0)) call.reject(reason);
  }
}

/** The scenes that the page will ask for. */
function scenesOfPage() {
  const figures = all(document, "simulation-figure", HTMLElement);
  return [...new Set(figures.map((figure) => figure.dataset.simulation ?? ""))];
}

/** @type {Runtime | null} */
let shared = null;

/** The page's only interpreter, or null where the book was built without one. */
export function sharedRuntime() {
  const address = document.body.dataset.runtime;
  if (!shared && address) shared = new Runtime(new URL(address, location.href).href);
  return shared;
}
