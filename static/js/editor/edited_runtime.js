/**
 * Draws one figure by its reader's own code, in an interpreter of its own: whatever that code does
 * there, the book's interpreter and all other figures never meet it.
 */

import { EDITED } from "../runtime/patience.js";
import { Runtime, RuntimeFailure, closed } from "../runtime/runtime.js";
import { told, words } from "../page/words.js";

/** @import { Caller, Payload } from "../runtime/runtime.js" */
/** @import { Said } from "../page/words.js" */
/** @typedef {{message: string | Said, definition: string, line: number}} Problem */

/** The reader's code failed; `problem` tells where. */
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
  /** @type {Promise<number> | null} What the limit is, once the interpreter is warm. */
  #warm = null;
  /** What draws the figure: JSON of definitions and texts. */
  #edits = "{}";
  /** @type {Payload} What was last asked for a frame. */
  #frame = {};
  /** @type {{asked: string, reply: any} | null} A frame that is ready, and what was asked for it. */
  #ready = null;

  /**
   * @param {Runtime} book
   * @param {object} told
   * @param {(printed: string) => void} told.drawn Called with what a frame's code printed.
   * @param {(failure: EditFailure) => void} told.failed Called when a frame could not be computed.
   * @param {(message: string) => void} told.stopped Called when one did not end. From then on the
   *   book's own code draws the figure.
   */
  constructor(book, told) {
    this.book = book;
    this.told = told;
  }

  get generation() {
    return this.#own?.generation ?? 0;
  }

  /**
   * As of any runtime; frames and their errors are those of the edited code.
   *
   * @param {string} name
   * @param {Payload} payload
   * @param {() => number} [urgency]
   * @returns {Promise<any>}
   */
  async call(name, payload, urgency) {
    if (name === "pull") return await this.book.call(name, payload, urgency); // of the controls
    if (name !== "render") {
      if (name === "photograph") this.#ready = null; // it shows another picture
      return await this.#ask(name, payload, this.#edits, urgency);
    }
    try {
      const reply = this.#take(payload) ?? (await this.draw(payload, this.#edits, urgency));
      this.told.drawn(reply.printed);
      return reply;
    } catch (error) {
      if (error instanceof EditFailure) this.told.failed(error);
      if (!(error instanceof RuntimeFailure) || error.kind !== "lost") throw error;
      this.told.stopped(error.message);
      return await this.book.call(name, payload, urgency);
    }
  }

  /**
   * From now on, draw by `edits`, which have drawn a frame.
   *
   * @param {string} edits
   * @param {Payload} payload What was asked for the frame.
   * @param {any} reply The frame.
   */
  adopt(edits, payload, reply) {
    this.#edits = edits;
    this.#ready = { asked: JSON.stringify(payload), reply };
  }

  /** @param {ArrayBuffer[]} rasters */
  recycle(rasters) {
    this.#own?.recycle(rasters);
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
    this.#warm = null;
  }

  /**
   * One frame by `edits`.
   *
   * @param {Payload} payload
   * @param {string} edits
   * @param {() => number} [urgency]
   * @returns {Promise<any>}
   * @throws {RuntimeFailure} An `EditFailure` where the code raised, `lost` where it was stopped.
   */
  async draw(payload, edits, urgency) {
    const reply = await this.#ask("renderEdited", payload, edits, urgency);
    if (reply.problem) throw new EditFailure(reply.problem, reply.printed);
    return reply;
  }

  /**
   * Have an interpreter with the figure's modules imported, before edited code is timed.
   *
   * @param {Payload} payload
   * @returns {Promise<number>} The limit for edited code.
   */
  warm(payload) {
    if (payload.scene) this.#frame = payload;
    const { scene } = this.#frame;
    this.#own ??= new Runtime(this.book.url, () => (scene ? [scene] : []));
    this.#warm ??= this.#own.call("render", this.#frame).then(
      ({ computeMs }) => Math.max(EDITED.ms, EDITED.times * computeMs),
      (error) => {
        if (error instanceof RuntimeFailure && error.kind === "python") return EDITED.ms;
        this.#warm = null;
        throw error;
      },
    );
    return this.#warm;
  }

  /**
   * The frame that is ready, if it is the one asked for. It can be had once.
   *
   * @param {Payload} payload
   */
  #take(payload) {
    const ready = this.#ready;
    this.#ready = null;
    return ready?.asked === JSON.stringify(payload) ? ready.reply : null;
  }

  /**
   * @param {string} name
   * @param {Payload} payload
   * @param {string} edits
   * @param {() => number} [urgency]
   * @returns {Promise<any>}
   */
  async #ask(name, payload, edits, urgency) {
    const limit = await this.warm(payload);
    if (!this.#own) throw closed();
    try {
      return await this.#own.call(name, { ...payload, edits, limit }, urgency);
    } catch (error) {
      if (!(error instanceof RuntimeFailure) || error.kind !== "lost") throw error;
      this.#warm = null; // the next interpreter is a new one
      throw new RuntimeFailure("lost", inWords(error, limit));
    }
  }
}

/**
 * @param {RuntimeFailure} failure
 * @param {number} limit
 */
function inWords({ late, message }, limit) {
  return late ? words("runtime.late_by", { seconds: Math.round(limit / 1000) }) : message;
}
