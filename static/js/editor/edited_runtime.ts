/**
 * Draws one figure by edited code in a separate interpreter, so that the book's interpreter and all
 * other figures are unaffected.
 */

import { printable } from "../errors.ts";
import { messageText, words, type Message } from "../page/words.ts";
import {
  EDITED_LIMIT,
  type CallName,
  type FrameReply,
  type FrameRequest,
  type Requests,
} from "../runtime/messages.ts";
import { Runtime, RuntimeFailure, closedFailure, startConfinedWorker } from "../runtime/runtime.ts";

export type Problem = { message: string | Message; definition: string; line: number };

/** The reader's code failed; `problem` says where. */
export class EditFailure extends RuntimeFailure {
  constructor(
    readonly problem: Problem,
    readonly printed: string,
  ) {
    super("python", printable(messageText(problem.message)));
  }
}

export class EditedRuntime {
  #runtime: Runtime | null = null;
  /** The time limit, once the interpreter has drawn the book's frame. */
  #limit: Promise<number> | null = null;
  /** What draws the figure: JSON of definitions and texts. */
  #edits = "{}";
  #frame: FrameRequest | null = null;
  /** A frame drawn already, and the request for it. */
  #ready: { request: string; reply: any } | null = null;

  /**
   * @param on.drawn Called with what a frame's code printed.
   * @param on.failed Called when a frame could not be computed.
   * @param on.stopped Called when one did not end. From then on the book's own code draws the
   *   figure.
   */
  constructor(
    readonly book: Runtime,
    readonly on: {
      drawn: (printed: string) => void;
      failed: (failure: EditFailure) => void;
      stopped: (message: string) => void;
    },
  ) {}

  get generation() {
    return this.#runtime?.generation ?? 0;
  }

  get waitsFor() {
    return (this.#runtime ?? this.book).waitsFor;
  }

  restart() {
    (this.#runtime ?? this.book).restart();
  }

  /** Calls of any runtime; frames and their errors are those of the edited code. */
  async call<Name extends CallName>(
    name: Name,
    request: Requests[Name],
    urgency?: () => number,
  ): Promise<any> {
    const any: any = request;
    if (name === "pull") return await this.book.call(name, request, urgency); // of the controls
    if (name === "photograph" || name === "readings") this.#ready = null; // of other pictures
    if (name !== "render") return await this.#callEdited(name, any, this.#edits, urgency);
    try {
      const reply = this.#takeAdopted(any) ?? (await this.draw(any, this.#edits, urgency));
      this.on.drawn(reply.printed);
      return reply;
    } catch (error) {
      if (error instanceof EditFailure) this.on.failed(error);
      if (!(error instanceof RuntimeFailure) || error.kind !== "lost") throw error;
      if (this.#runtime) this.on.stopped(error.message); // else it was ended on purpose
      return await this.book.call(name, request, urgency);
    }
  }

  /** Draw by `edits`, which have drawn a frame. */
  adopt(edits: string, request: FrameRequest, reply: FrameReply) {
    this.#edits = edits;
    this.#ready = { request: JSON.stringify(request), reply };
  }

  forget(figure: string) {
    this.close();
    this.book.forget(figure);
  }

  /** End the interpreter. */
  close() {
    this.#runtime?.close();
    this.#runtime = null;
    this.#limit = null;
  }

  /**
   * One frame by `edits`.
   *
   * @throws {RuntimeFailure} An `EditFailure` where the code raised, `lost` where it was stopped.
   */
  async draw(
    request: FrameRequest,
    edits: string,
    urgency?: () => number,
  ): Promise<FrameReply & { printed: string }> {
    const reply = await this.#callEdited("render_edited", request, edits, urgency);
    if (reply.problem) throw new EditFailure(reply.problem, reply.printed);
    return reply;
  }

  /**
   * Have an interpreter with the figure's modules imported, before edited code is timed.
   *
   * @returns The limit for edited code.
   */
  warm(frame: FrameRequest): Promise<number> {
    const { scene } = frame;
    this.#frame = frame;
    this.#runtime ??= new Runtime(this.book.url, () => [scene], startConfinedWorker);
    this.#limit ??= this.#runtime.call("render", frame).then(
      ({ computeMs }) => Math.max(EDITED_LIMIT.ms, EDITED_LIMIT.times * computeMs),
      (error) => {
        if (error instanceof RuntimeFailure && error.kind === "python") return EDITED_LIMIT.ms;
        this.#limit = null;
        throw error;
      },
    );
    return this.#limit;
  }

  /** The frame that was adopted, if it is the one requested. It can be had once. */
  #takeAdopted(request: FrameRequest) {
    const ready = this.#ready;
    this.#ready = null;
    return ready?.request === JSON.stringify(request) ? ready.reply : null;
  }

  async #callEdited(
    name: import("../runtime/messages.ts").CallName,
    request: any,
    edits: string,
    urgency?: () => number,
  ): Promise<any> {
    const frame = request.scene ? request : this.#frame;
    const limit = await this.warm(frame);
    if (!this.#runtime) throw closedFailure();
    try {
      return await this.#runtime.call(name, { ...request, edits }, urgency, limit);
    } catch (error) {
      if (!(error instanceof RuntimeFailure) || error.kind !== "lost") throw error;
      this.#limit = null; // the next interpreter is a new one
      const seconds = Math.round(limit / 1000);
      const reason = error.late ? words("runtime.late_by", { seconds }) : error.message;
      throw new RuntimeFailure("lost", reason);
    }
  }
}
