/** `<simulation-figure>`: a still that comes alive in place, where the browser can run Python. */

import { one } from "../page/dom.js";
import { Runtime, sharedRuntime } from "../runtime/runtime.js";
import { LiveFigure } from "./live.js";
import { say } from "./status.js";

export class SimulationFigure extends HTMLElement {
  /** @type {LiveFigure | null} */
  #live = null;

  connectedCallback() {
    const runtime = sharedRuntime();
    if (!runtime) return;
    if (Runtime.supported) this.#live = new LiveFigure(this, runtime);
    else this.#refuse();
  }

  disconnectedCallback() {
    this.#live?.leave();
    this.#live = null;
  }

  /** Try again what failed; the figure keeps its values. */
  retry() {
    this.#live?.retry();
  }

  /**
   * Which condition is the first to hold of the figure's present state; null where none does.
   *
   * @param {string[]} conditions
   * @returns {Promise<number | null>}
   * @throws {Error} Where the figure does not run.
   */
  async judge(conditions) {
    if (!this.#live) throw new Error("the figure does not run in this browser");
    return this.#live.judge(conditions);
  }

  /** This browser cannot run the figure: say so once, and offer no dead controls. */
  #refuse() {
    one(this, "form.controls", HTMLFormElement).hidden = true;
    this.dataset.state = "failed";
    say(this, "This figure stays as it is: the browser does not offer WebAssembly.");
  }
}
