/**
 * The page's side of the worker that runs Python.
 *
 * One call is in the worker at a time; the rest wait here, so that the most urgent goes next and a
 * worker that does not answer can be told from a busy one. Such a worker is replaced; waiting calls
 * stay.
 */

import { all } from "../page/dom.ts";
import { words } from "../page/words.ts";
import { findLoadError, type LoadErrorData, type LoadErrorKind } from "./load_error.ts";
import { CALLS, type CallName, type Replies, type Requests } from "./messages.ts";
import { Watchdog } from "./watchdog.ts";

interface Circumstances {
  late?: boolean;
  loadError?: LoadErrorKind;
  begun?: number;
}

/**
 * Why a call failed: `python` (our code raised), `start` (no interpreter), `part` (one of its files
 * did not arrive), `lost` (no answer).
 */
export class RuntimeFailure extends Error {
  readonly late: boolean;
  readonly loadError: string | undefined;
  readonly begun: number;

  /** @param more Whether it was the time limit; what is wrong with a file; when its worker began. */
  constructor(
    readonly kind: "python" | "start" | "part" | "lost",
    message: string,
    { late = false, loadError, begun = Infinity }: Circumstances = {},
  ) {
    super(message);
    this.late = late;
    this.loadError = loadError;
    this.begun = begun;
  }
}

/** Error of an interpreter that is ended on purpose. */
export function closed() {
  return new RuntimeFailure("lost", words("runtime.closed"));
}

/** What figures need of a runtime. */
export interface Caller {
  call: <N extends CallName>(
    name: N,
    request: Requests[N],
    urgency?: () => number,
  ) => Promise<Replies[N]>;
  forget: (figure: string) => void;
  close: () => void;
  generation: number;
}

interface Call {
  id: number;
  name: CallName;
  request: Record<string, any>;
  /** Longest wait for an answer, in milliseconds. */
  limit: number;
  /** Compared when the worker is free: the highest goes first. */
  urgency: () => number;
  resolve: (reply: any) => void;
  reject: (reason: RuntimeFailure) => void;
}

let interpreters = 0;

export class Runtime {
  #waiting: Call[] = [];
  #active: Call | null = null;
  #worker: Worker | null = null;
  #watchdog = new Watchdog();
  #lastId = 0;
  #failedStarts = 0;
  /** When the worker was started. */
  #begun = 0;
  /** Whether an interpreter that continued from the snapshot broke as it imported its first scene. */
  #plain = false;
  /** Number of the interpreter: a new one has nothing of what was sent to the last. */
  generation = 0;

  readonly scenes: () => string[];
  readonly early: () => Worker | null;

  /**
   * @param url Absolute address of the runtime folder.
   * @param scenes Asked when a worker starts: which scenes it will need.
   * @param early A worker that is starting already, if there is one.
   */
  constructor(
    readonly url: string,
    scenes: () => string[] = scenesOfPage,
    early: () => Worker | null = () => null,
  ) {
    this.scenes = scenes;
    this.early = early;
  }

  /** Whether this browser can run the interpreter at all. */
  static get supported() {
    return typeof WebAssembly === "object" && typeof Worker === "function";
  }

  /** The worker's answer. Waiting calls are sent by `urgency`, the highest first. */
  call<Name extends CallName>(
    name: Name,
    request: Requests[Name],
    urgency: () => number = () => 0,
    limit: number = CALLS[name].limit,
  ): Promise<Replies[Name]> {
    return new Promise((resolve, reject) => {
      this.#waiting.push({ id: ++this.#lastId, name, request, limit, urgency, resolve, reject });
      this.#next();
    });
  }

  /** Drop what belongs to a figure that left the page, here and in the worker. */
  forget(figure: string) {
    const leaving = this.#waiting.filter(({ request }) => request.figure === figure);
    this.#waiting = this.#waiting.filter((call) => !leaving.includes(call));
    for (const call of leaving) call.reject(new RuntimeFailure("lost", words("runtime.gone")));
    // In a task of its own, after what the next page's figures ask.
    setTimeout(() => {
      if (this.#worker) this.call("forget", { figure }).catch(() => {});
    });
  }

  /** End the worker; waiting calls fail. */
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
    this.generation = ++interpreters;
    this.#begun = performance.now();
    const script = new URL("./worker.js", import.meta.url);
    const worker = this.early() ?? new Worker(script, { type: "module" });
    this.#worker = worker;
    worker.onmessage = (event) => this.#receive(event.data);
    worker.onerror = async (event) => {
      event.preventDefault();
      const { data } = await findLoadError(script.href);
      if (this.#worker !== worker) return;
      if (data.kind === "other") this.#lose(event.message || words("runtime.no_worker"));
      else this.#lose(inWords(data), { loadError: data.kind });
    };
    worker.onmessageerror = () => this.#lose(words("runtime.unreadable"));
    const { table } = document.body.dataset;
    const fresh = this.#failedStarts > 0;
    const scenes = this.scenes();
    const request: Requests["start"] = { url: this.url, table, scenes, fresh, plain: this.#plain };
    this.#send({
      id: ++this.#lastId,
      name: "start",
      request,
      limit: CALLS.start.limit,
      urgency: () => 0,
      resolve: () => (this.#failedStarts = 0),
      reject: (reason) => this.#giveUp(reason),
    });
  }

  #send(call: Call) {
    this.#active = call;
    this.#watch(call.limit);
    const { picture } = call.request;
    const transfer: Transferable[] = picture ? [picture.bitmap] : [];
    if (picture?.mosaic) transfer.push(picture.mosaic.codes.buffer);
    this.#worker?.postMessage({ id: call.id, call: call.name, ...call.request }, { transfer });
  }

  #watch(limit: number) {
    this.#watchdog.start(limit, () => this.#lose(words("runtime.late"), { late: true }));
  }

  #receive(reply: any) {
    const call = this.#active;
    if (!call || call.id !== reply.id) return;
    if ("fetching" in reply) {
      this.#watch(reply.fetching ? CALLS.start.limit : call.limit);
      return;
    }
    const message = reply.loadError ? inWords(reply.loadError) : reply.error;
    const more = { loadError: reply.loadError?.kind };
    if (!reply.ok && (reply.fatal || call.name === "start")) {
      this.#plain ||= call.name === "prepare";
      this.#lose(message, more);
      return;
    }
    this.#settle();
    if (reply.ok) call.resolve(reply);
    else call.reject(new RuntimeFailure(reply.loadError ? "part" : "python", message, more));
    this.#next();
  }

  /** The worker is of no more use: end it, reject its call, and go on with a new one. */
  #lose(message: string, more?: Circumstances) {
    const call = this.#active;
    this.#settle();
    this.#worker?.terminate();
    this.#worker = null;
    call?.reject(
      new RuntimeFailure(call.name === "start" ? "start" : "lost", message, {
        ...more,
        begun: this.#begun,
      }),
    );
    this.#next();
  }

  #settle() {
    this.#watchdog.stop();
    this.#active = null;
  }

  /** No interpreter: all waiting calls fail; the next one tries again. */
  #giveUp(reason: RuntimeFailure) {
    if (!reason.late) this.#failedStarts += 1; // what has arrived of a slow download is good
    for (const call of this.#waiting.splice(0)) call.reject(reason);
  }
}

function inWords(error: LoadErrorData | { kind: "memory" }) {
  return words(`runtime.${error.kind}`, error);
}

/** The scenes that the page will ask for. */
function scenesOfPage() {
  const figures = all(document, "simulation-figure", HTMLElement);
  return [...new Set(figures.map((figure) => figure.dataset.simulation ?? ""))];
}

/** The worker that the page's head has started, once. */
function takeEarlyWorker() {
  const page = globalThis as { earlyWorker?: Worker };
  const worker = page.earlyWorker ?? null;
  delete page.earlyWorker;
  return worker;
}

let shared: Runtime | null = null;

/** The page's only interpreter, or null where the book was built without one. */
export function sharedRuntime() {
  const address = document.body.dataset.runtime;
  if (!shared && address) {
    shared = new Runtime(new URL(address, location.href).href, scenesOfPage, takeEarlyWorker);
  }
  return shared;
}
