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
    if (!Runtime.supported) this.#refuse();
    else if (this.#isAddressed) this.#arrive(runtime);
    else this.#live = new LiveFigure(this, runtime);
  }

  disconnectedCallback() {
    this.#live?.leave();
    this.#live = null;
  }

  /** Try again what failed; the figure keeps its values. */
  retry() {
    this.#live?.retry();
  }

  /** Whether the address of the page says how the figure should stand. */
  get #isAddressed() {
    const id = this.closest("figure")?.id;
    return [...new URLSearchParams(location.search).keys()].some((key) => key.startsWith(`${id}.`));
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
      if (this.isConnected) this.#live = new LiveFigure(this, runtime);
    }
  }

  /** This browser cannot run the figure: say so once, and offer no dead controls. */
  #refuse() {
    one(this, "form.controls", HTMLFormElement).hidden = true;
    this.dataset.state = "failed";
    say(this, "This figure stays as it is: the browser does not offer WebAssembly.");
  }
}
