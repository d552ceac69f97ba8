/** `<simulation-figure>`: a still that comes alive in place, where the browser can run Python. */

import { isStartDeferred } from "../page/data_saver.ts";
import { findAll } from "../page/dom.ts";
import { words } from "../page/words.ts";
import { EDITED_LIMIT, CALLS } from "../runtime/messages.ts";
import { Runtime, startConfinedWorker, sharedRuntime } from "../runtime/runtime.ts";
import { isAddressed, moveControls } from "./controls.ts";
import { LiveFigure } from "./live.ts";
import { leaderOf } from "./parts.ts";
import { Overlay } from "./overlay.ts";
import { showMessage } from "./status.ts";

export class SimulationFigure extends HTMLElement {
  /**
   * What figures run on, for programs that drive a page from outside, as tests do: scripts are
   * bundled, and no address leads to one of them.
   */
  static internals = {
    EDITED_LIMIT,
    Overlay,
    Runtime,
    CALLS,
    startConfinedWorker,
    moveControls,
    sharedRuntime,
  };
  /** Null where the figure does not run, and for a part, which its leader's serves. */
  live: LiveFigure | null = null;

  connectedCallback() {
    const runtime = sharedRuntime();
    if (!runtime) return;
    if (!Runtime.supported) this.#refuse();
    else if (this.dataset.with) return;
    else if (isAddressed(this)) this.#startAtAddress(runtime);
    else this.#start(runtime);
  }

  disconnectedCallback() {
    this.dispatchEvent(new Event("figure-leave"));
    this.live?.leave();
    this.live = null;
  }

  /** Whether the frame that was requested last is shown, or has failed. */
  get rests(): boolean {
    return this.#leader.live?.rests ?? true;
  }

  /** Start what waited for the reader to ask. */
  begin() {
    this.live?.retry();
    this.#announce();
  }

  /** Try again what failed; the figure keeps its values. */
  retry() {
    this.live?.retry();
  }

  /** Which condition is the first to hold of the figure's state; an error where it does not run. */
  async judge(conditions: string[]): Promise<number | null> {
    const { live } = this.#leader;
    if (!live) throw new Error(words("figure.does_not_run"));
    return live.judge(conditions);
  }

  /** The figure that has this one's settings. */
  get #leader(): SimulationFigure {
    const leader = leaderOf(this);
    return leader instanceof SimulationFigure ? leader : this;
  }

  #start(runtime: Runtime) {
    this.live = new LiveFigure(this, runtime);
    if (!isStartDeferred()) this.#announce();
  }

  /** Python may run now. */
  #announce() {
    this.dispatchEvent(new Event("figure-start", { bubbles: true }));
  }

  /** Put the controls to where the address says before the first frame is requested. */
  async #startAtAddress(runtime: Runtime) {
    try {
      const { applyAddress } = await import("./permalink.ts");
      applyAddress(this);
    } finally {
      if (this.isConnected) this.#start(runtime);
    }
  }

  /** This browser cannot run the figure: say so once, and offer no dead controls. */
  #refuse() {
    for (const controls of findAll(this, ".control-grid, .more-controls", HTMLElement)) {
      controls.hidden = true;
    }
    this.dataset.state = "failed";
    showMessage(this, words("figure.no_assembly"));
  }
}
