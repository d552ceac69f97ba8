/** `<simulation-figure>`: a still that comes alive in place, where the browser can run Python. */

import { message } from "../errors.js";
import { one, within } from "../page/dom.js";
import { offerRelease } from "../page/release.js";
import { recall } from "../page/storage.js";
import { EDITED, Patience } from "../runtime/patience.js";
import { Runtime, sharedRuntime } from "../runtime/runtime.js";
import { moveControls } from "./controls.js";
import { LiveFigure } from "./live.js";
import { Overlay } from "./overlay.js";
import { say } from "./status.js";
import { isSparing } from "../page/sparing.js";
import { words } from "../page/words.js";

/** @import { Workshop } from "../editor/workshop.js" */

export class SimulationFigure extends HTMLElement {
  /**
   * What figures run on, for who drives a page from outside, as tests do: a page's scripts are joined,
   * and no address leads to one of them.
   */
  static inside = { EDITED, Overlay, Patience, Runtime, moveControls, sharedRuntime };
  /** @type {LiveFigure | null} */
  #live = null;
  /** @type {Promise<Workshop> | null} Where the reader opened the figure's Python, now or before. */
  #workshop = null;

  connectedCallback() {
    const runtime = sharedRuntime();
    if (!runtime) return;
    this.onclick = (/** @type {MouseEvent} */ event) => {
      if (within(event, ".open-python", HTMLButtonElement)) this.#openPython(runtime);
    };
    if (!Runtime.supported) this.#refuse();
    else if (this.#isAddressed) this.#arrive(runtime);
    else this.#begin(runtime);
  }

  disconnectedCallback() {
    this.#workshop?.then((workshop) => workshop.leave());
    this.#workshop = null;
    this.#live?.leave();
    this.#live = null;
  }

  /** Whether the frame that was asked for last is shown, or has failed. */
  get rests() {
    return this.#live?.rests ?? true;
  }

  /** Start what waited for the reader to ask. */
  begin() {
    const runtime = sharedRuntime();
    this.#live?.retry();
    if (runtime) this.#resume(runtime);
  }

  /** Try again what failed; the figure keeps its values. */
  retry() {
    this.#live?.retry();
  }

  /** @param {Runtime} runtime */
  async #openPython(runtime) {
    try {
      await (await this.#python(runtime)).toggle();
    } catch (error) {
      this.#workshop = null;
      say(this, words("figure.no_python", { reason: message(error) }));
      offerRelease();
    }
  }

  /** @param {Runtime} runtime */
  async #resumePython(runtime) {
    try {
      await (await this.#python(runtime)).resume();
    } catch {
      this.#workshop = null; // the figure shows what the book's code draws
    }
  }

  /**
   * The workshop, fetched when it is first needed.
   *
   * @param {Runtime} runtime
   * @returns {Promise<Workshop>}
   */
  #python(runtime) {
    this.#workshop ??= import("../editor/workshop.js").then(
      ({ Workshop }) => new Workshop(this, this.#live, runtime, keptUnder(this)),
    );
    return this.#workshop;
  }

  /**
   * Which condition is the first to hold of the figure's present state; null where none does.
   *
   * @param {string[]} conditions
   * @returns {Promise<number | null>}
   * @throws {Error} Where the figure does not run.
   */
  async judge(conditions) {
    if (!this.#live) throw new Error(words("figure.does_not_run"));
    return this.#live.judge(conditions);
  }

  /** Whether the address of the page says how the figure should stand. */
  get #isAddressed() {
    const id = this.closest("figure")?.id;
    return [...new URLSearchParams(location.search).keys()].some((key) => key.startsWith(`${id}.`));
  }

  /** @param {Runtime} runtime */
  #begin(runtime) {
    this.#live = new LiveFigure(this, runtime);
    if (!isSparing()) this.#resume(runtime);
  }

  /**
   * Have the reader's own version of the figure's Python draw, where there is one.
   *
   * @param {Runtime} runtime
   */
  #resume(runtime) {
    if (recall(keptUnder(this))?.runs) this.#resumePython(runtime);
  }

  /**
   * Put the controls to where the address says before the first frame is asked for.
   *
   * @param {Runtime} runtime
   */
  async #arrive(runtime) {
    try {
      const { arrive } = await import("./permalink.js");
      arrive(this);
    } finally {
      if (this.isConnected) this.#begin(runtime);
    }
  }

  /** This browser cannot run the figure: say so once, and offer no dead controls. */
  #refuse() {
    one(this, "form.controls", HTMLFormElement).hidden = true;
    this.dataset.state = "failed";
    say(this, words("figure.no_assembly"));
  }
}

/**
 * Under which name a reader's version of the figure's Python is kept; each figure has its own.
 *
 * @param {HTMLElement} element
 */
function keptUnder(element) {
  const root = new URL(document.body.dataset.root || "./", location.href).pathname;
  const page = location.pathname.slice(root.length).replace(/index\.html$/, "");
  return `python:${page}#${element.closest("figure")?.id ?? ""}`;
}
