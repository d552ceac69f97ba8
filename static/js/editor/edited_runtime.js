/**
 * Draws one figure by its reader's own code, in an interpreter of its own: whatever that code does
 * there, the book's interpreter and all other figures are unaffected.
 */

import { told, words } from "../page/words.js";
import { EDITED } from "../runtime/messages.js";
import { Runtime, RuntimeFailure, closed } from "../runtime/runtime.js";

/** @import { Caller } from "../runtime/runtime.js" */
/** @import { FrameReply, FrameRequest } from "../runtime/messages.js" */
/** @import { Said } from "../page/words.js" */
/** @typedef {{message: string | Said, definition: string, line: number}} Problem */

/** The reader's code failed; `problem` says where. */
export class EditFailure extends RuntimeFailure {
  /**
   * @param {Problem} problem
   * @param {string} printed
   */
  constructor(problem, printed) {
    super("python", told(problem.message));
    this.problem = problem;
    this.printed = printed;
  }
}

export class EditedRuntime {
  /** @type {Runtime | null} */
  #own = null;
  /** @type {Promise<number> | null} The time limit, once the interpreter has drawn the book's frame. */
  #limit = null;
  /** What draws the figure: JSON of definitions and texts. */
  #edits = "{}";
  /** @type {FrameRequest | null} */
  #frame = null;
  /** @type {{request: string, reply: any} | null} A frame drawn already, and the request for it. */
  #ready = null;

  /**
   * @param {Runtime} book
   * @param {object} on
   * @param {(printed: string) => void} on.drawn Called with what a frame's code printed.
   * @param {(failure: EditFailure) => void} on.failed Called when a frame could not be computed.
   * @param {(message: string) => void} on.stopped Called when one did not end. From then on the
   *   book's own code draws the figure.
   */
  constructor(book, on) {
    this.book = book;
    this.on = on;
  }

  get generation() {
    return this.#own?.generation ?? 0;
  }

  /**
   * As of any runtime; frames and their errors are those of the edited code.
   *
   * @type {Caller["call"]}
   */
  async call(name, request, urgency) {
    /** @type {any} */
    const any = request;
    if (name === "pull") return await this.book.call(name, request, urgency); // of the controls
    if (name === "photograph") this.#ready = null; // it shows another picture
    if (name !== "render") return await this.#ask(name, any, this.#edits, urgency);
    try {
      const reply = this.#take(any) ?? (await this.draw(any, this.#edits, urgency));
      this.on.drawn(reply.printed);
      return reply;
    } catch (error) {
      if (error instanceof EditFailure) this.on.failed(error);
      if (!(error instanceof RuntimeFailure) || error.kind !== "lost") throw error;
      this.on.stopped(error.message);
      return await this.book.call(name, request, urgency);
    }
  }

  /**
   * From now on, draw by `edits`, which have drawn a frame.
   *
   * @param {string} edits
   * @param {FrameRequest} request
   * @param {FrameReply} reply
   */
  adopt(edits, request, reply) {
    this.#edits = edits;
    this.#ready = { request: JSON.stringify(request), reply };
  }

  /** @param {string} figure */
  forget(figure) {
    this.close();
    this.book.forget(figure);
  }

  /** End the interpreter. */
  close() {
    this.#own?.close();
    this.#own = null;
    this.#limit = null;
  }

  /**
   * One frame by `edits`.
   *
   * @param {FrameRequest} request
   * @param {string} edits
   * @param {() => number} [urgency]
   * @returns {Promise<FrameReply & {printed: string}>}
   * @throws {RuntimeFailure} An `EditFailure` where the code raised, `lost` where it was stopped.
   */
  async draw(request, edits, urgency) {
    const reply = await this.#ask("renderEdited", request, edits, urgency);
    if (reply.problem) throw new EditFailure(reply.problem, reply.printed);
    return reply;
  }

  /**
   * Have an interpreter with the figure's modules imported, before edited code is timed.
   *
   * @param {FrameRequest} frame
   * @returns {Promise<number>} The limit for edited code.
   */
  warm(frame) {
    const { scene } = frame;
    this.#frame = frame;
    this.#own ??= new Runtime(this.book.url, () => [scene]);
    this.#limit ??= this.#own.call("render", frame).then(
      ({ computeMs }) => Math.max(EDITED.ms, EDITED.times * computeMs),
      (error) => {
        if (error instanceof RuntimeFailure && error.kind === "python") return EDITED.ms;
        this.#limit = null;
        throw error;
      },
    );
    return this.#limit;
  }

  /**
   * The frame that was adopted, if it is the one requested. It can be had once.
   *
   * @param {FrameRequest} request
   */
  #take(request) {
    const ready = this.#ready;
    this.#ready = null;
    return ready?.request === JSON.stringify(request) ? ready.reply : null;
  }

  /**
   * @param {import("../runtime/messages.js").CallName} name
   * @param {any} request
   * @param {string} edits
   * @param {() => number} [urgency]
   * @returns {Promise<any>}
   */
  async #ask(name, request, edits, urgency) {
    const frame = request.scene ? request : this.#frame;
    const limit = await this.warm(frame);
    if (!this.#own) throw closed();
    try {
      return await this.#own.call(name, { ...request, edits, limit }, urgency);
    } catch (error) {
      if (!(error instanceof RuntimeFailure) || error.kind !== "lost") throw error;
      this.#limit = null; // the next interpreter is a new one
      const seconds = Math.round(limit / 1000);
      const reason = error.late ? words("runtime.late_by", { seconds }) : error.message;
      throw new RuntimeFailure("lost", reason);
    }
  }
}
