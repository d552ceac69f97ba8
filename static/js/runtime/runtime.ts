/**
 * The page's side of the worker that runs Python.
 *
 * One call is in the worker at a time; the rest wait here, so that the most urgent goes next and a
 * worker that does not answer differs from a busy one. Such a worker is replaced; waiting calls
 * stay.
 */

import { printable } from "../errors.ts";
import { findAll } from "../page/dom.ts";
import { words } from "../page/words.ts";
import {
  fetchListed,
  findLoadError,
  LoadError,
  type LoadErrorData,
  type LoadErrorKind,
} from "./load_error.ts";
import {
  CALLS,
  isReply,
  isSignal,
  type CallName,
  type Replies,
  type Requests,
} from "./messages.ts";
import { Watchdog } from "./watchdog.ts";

interface FailureDetails {
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

  /** @param details Whether it was the time limit; what is wrong with a file; when its worker began. */
  constructor(
    readonly kind: "python" | "start" | "part" | "lost",
    message: string,
    { late = false, loadError, begun = Infinity }: FailureDetails = {},
  ) {
    super(message);
    this.late = late;
    this.loadError = loadError;
    this.begun = begun;
  }
}

/** Error of an interpreter that is ended on purpose. */
export function closedFailure() {
  return new RuntimeFailure("lost", words("runtime.closed"));
}

/** The part of a runtime that figures use. */
export interface Caller {
  call: <N extends CallName>(
    name: N,
    request: Requests[N],
    urgency?: () => number,
  ) => Promise<Replies[N]>;
  forget: (figure: string) => void;
  close: () => void;
  restart: () => void;
  generation: number;
  waitsFor: Wait;
}

/** What the worker does: fetch its script or a `file`, start Python, or compute. */
type Wait = { what: "script" | "file" | "python" | "frame"; file: string };

/** Longest time in which files may arrive, in milliseconds. */
const LONGEST_FETCH = 300_000;
/** Milliseconds in which an idle worker shows that it has a call; longer where its start took longer. */
const PING = 2000;

type Failure = { error: string; fatal: boolean; loadError?: any };

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

/** Urgency of what no reader waits for. */
const LAST = -2;

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
  /** Milliseconds in which the last interpreter started: the pace of this machine. */
  #pace = 0;
  /** When the call was sent to the worker, and the file that it waits for; null before a sign of it. */
  #sent = 0;
  #waits: string | null = null;
  /** Whether an interpreter that continued from the snapshot broke as it imported its first scene. */
  #plain = false;
  /** Number of the interpreter: a new one has nothing of what was sent to the last. */
  generation = 0;

  readonly scenes: () => string[];
  readonly createWorker: (script: URL) => Worker;

  /**
   * @param url Absolute address of the runtime folder.
   * @param scenes Asked when a worker starts: which scenes it will need.
   * @param createWorker Starts a worker.
   */
  constructor(
    readonly url: string,
    scenes: () => string[],
    createWorker: (script: URL) => Worker = startWorker,
  ) {
    this.scenes = scenes;
    this.createWorker = createWorker;
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
    // In a later task, after the requests of the next page's figures.
    setTimeout(() => {
      if (this.#worker) this.call("forget", { figure }, () => LAST).catch(() => {});
    });
  }

  /** End the worker; waiting calls fail. */
  close() {
    for (const call of this.#waiting.splice(0)) call.reject(closedFailure());
    if (this.#worker) this.#endWorker(closedFailure().message);
  }

  /** What the call that is in the worker waits for. */
  get waitsFor(): Wait {
    const isStart = this.#active?.name === "start";
    if (this.#waits === null) return { what: isStart ? "script" : "frame", file: "worker.js" };
    if (this.#waits) return { what: "file", file: this.#waits };
    return { what: isStart ? "python" : "frame", file: "" };
  }

  /** Replace a worker that keeps the reader waiting; calls that wait stay. */
  restart() {
    const call = this.#active;
    if (call?.name === "start") {
      call.reject = () => {};
      this.#failedStarts += 1;
    }
    this.#endWorker(words("runtime.late"), { late: true });
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
    const worker = this.createWorker(script);
    this.#worker = worker;
    worker.onmessage = (event) => this.#receive(event.data);
    worker.onerror = async (event) => {
      event.preventDefault();
      const { data } = await findLoadError(script.href);
      if (this.#worker !== worker) return;
      if (data.kind === "other") this.#endWorker(event.message || words("runtime.no_worker"));
      else this.#endWorker(loadErrorText(data), { loadError: data.kind });
    };
    worker.onmessageerror = () => this.#endWorker(words("runtime.unreadable"));
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
      resolve: () => {
        this.#failedStarts = 0;
        this.#pace = performance.now() - this.#begun;
      },
      reject: (reason) => this.#giveUp(reason),
    });
  }

  #send(call: Call) {
    this.#active = call;
    [this.#sent, this.#waits] = [performance.now(), null];
    this.#watch(call.name === "start" ? call.limit : Math.max(PING, 2 * this.#pace));
    const { picture } = call.request;
    const transfer: Transferable[] = picture ? [picture.bitmap] : [];
    if (picture?.mosaic) transfer.push(picture.mosaic.codes.buffer);
    this.#worker?.postMessage({ id: call.id, call: call.name, ...call.request }, { transfer });
  }

  #watch(limit: number) {
    this.#watchdog.start(limit, () => this.#endWorker(words("runtime.late"), { late: true }));
  }

  #receive(reply: unknown) {
    const call = this.#active;
    if (!isSignal(reply)) {
      console.warn(words("runtime.unreadable"));
    } else if (call && call.id === reply.id) {
      if ("waits" in reply) this.#noteWait(call, reply.waits);
      else if ("wants" in reply) this.#sendChunk(reply.wants);
      else if (!reply.ok) this.#fail(call, reply);
      else if (!isReply(call.name, reply)) this.#endWorker(words("runtime.unreadable"));
      else this.#end(() => call.resolve(reply));
    }
  }

  async #sendChunk(chunk: string) {
    const worker = this.#worker;
    try {
      const archive = await fetchListed(this.url, chunk, document.body.dataset.table);
      worker?.postMessage({ chunk, archive }, [archive]);
    } catch (error) {
      const loadError = error instanceof LoadError ? error.data : { kind: "other", file: chunk };
      worker?.postMessage({ chunk, loadError });
    }
  }

  /** A sign of life. */
  #noteWait(call: Call, file: string) {
    this.#waits = file;
    const isEndless = file !== "" && performance.now() - this.#sent > LONGEST_FETCH;
    if (!isEndless) this.#watch(call.limit);
  }

  #fail(call: Call, { error, fatal, loadError }: Failure) {
    const message = loadError
      ? loadErrorText(loadError)
      : printable(error) || words("runtime.unreadable");
    const details = { loadError: loadError?.kind };
    if (fatal || call.name === "start") {
      this.#plain ||= call.name === "prepare";
      this.#endWorker(message, details);
      return;
    }
    const kind = loadError ? "part" : "python";
    this.#end(() => call.reject(new RuntimeFailure(kind, message, details)));
  }

  /** The worker is free. */
  #end(settle: () => void) {
    this.#settle();
    settle();
    this.#next();
  }

  /** The worker is of no more use: end it, reject its call, and go on with a new one. */
  #endWorker(message: string, details?: FailureDetails) {
    const call = this.#active;
    this.#settle();
    this.#worker?.terminate();
    this.#worker = null;
    call?.reject(
      new RuntimeFailure(call.name === "start" ? "start" : "lost", message, {
        ...details,
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

function loadErrorText(error: LoadErrorData | { kind: "memory" }) {
  return words(`runtime.${error.kind}`, error);
}

/** The scenes that the page will ask for. */
function scenesOfPage() {
  const figures = findAll(document, "simulation-figure", HTMLElement);
  return [...new Set(figures.map((figure) => figure.dataset.simulation ?? ""))];
}

function startWorker(script: URL) {
  return new Worker(script, { type: "module" });
}

/**
 * The worker that the page's head has started, once; then new ones. In a frame without an origin only
 * one from a blob starts.
 */
function takeEarlyWorker(script: URL) {
  if (self.origin === "null") return startConfinedWorker(script);
  const page = globalThis as { earlyWorker?: Worker };
  const worker = page.earlyWorker ?? startWorker(script);
  delete page.earlyWorker;
  return worker;
}

let confined = "";

/**
 * A worker under the policy of the page, which a worker inherits whose address is a blob's: nothing
 * that runs in it reaches another host.
 */
export function startConfinedWorker(script: URL) {
  const source = `import ${JSON.stringify(script.href)};`;
  confined ||= URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  return new Worker(confined, { type: "module" });
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
