/** The reader's own picture in a figure that takes one: chosen, handed to Python, and put back. */

import { message } from "../errors.js";
import { maybe, one, within } from "../page/dom.js";
import { say } from "./status.js";

/** @import { Caller } from "../runtime/runtime.js" */
/** @import { Photograph } from "./photograph.js" */

export class OwnPicture {
  /** @type {Photograph | null} */
  #picture = null;
  /** Number of the interpreter and of the picture that was last sent to it. */
  #sent = "";

  /**
   * @param {HTMLElement} figure
   * @param {[number, number] | null} size Width and height that its scene computes with.
   * @param {() => void} changed There is another picture, or none any more.
   * @param {AbortSignal} signal Ends all listening.
   */
  constructor(figure, size, changed, signal) {
    this.figure = figure;
    this.size = size;
    this.changed = changed;
    const box = maybe(figure, ".photograph", HTMLElement);
    box?.addEventListener("change", (event) => this.#choose(box, event), { signal });
    box?.addEventListener("click", (event) => this.#press(box, event), { signal });
  }

  /** Which picture it is; 0: that of the book. */
  get number() {
    return this.#picture?.number ?? 0;
  }

  /**
   * Send the picture to the interpreter, where that does not have it.
   *
   * @param {Caller} runtime
   * @param {string} key The figure's.
   */
  async handOver(runtime, key) {
    const { number = 0, ...picture } = this.#picture ?? {};
    const sending = () => `${runtime.generation} ${number}`;
    if (sending() === this.#sent || (number === 0 && !this.#sent)) return;
    await runtime.call("photograph", { figure: key, number, ...picture }, () => 2);
    this.#sent = sending();
  }

  /**
   * @param {HTMLElement} box
   * @param {Event} event
   */
  #press(box, event) {
    const button = within(event, "button", HTMLButtonElement);
    if (button?.classList.contains("photograph-choose")) {
      one(box, "input", HTMLInputElement).click();
    } else if (button) {
      this.#show(box, null);
    }
  }

  /**
   * @param {HTMLElement} box
   * @param {Event} event
   */
  async #choose(box, event) {
    const input = within(event, "input", HTMLInputElement);
    const file = input?.files?.[0];
    if (!input || !file || !this.size) return;
    try {
      const { decode } = await import("./photograph.js");
      const picture = await decode(file, ...this.size);
      if (!this.figure.isConnected) return;
      say(this.figure, "");
      this.#show(box, picture);
    } catch (error) {
      say(this.figure, message(error));
    } finally {
      input.value = ""; // the same file may be chosen again
    }
  }

  /**
   * @param {HTMLElement} box
   * @param {Photograph | null} picture
   */
  #show(box, picture) {
    this.#picture = picture;
    one(box, ".photograph-back", HTMLButtonElement).hidden = !picture;
    this.changed();
  }
}
