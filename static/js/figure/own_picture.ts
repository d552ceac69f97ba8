/** The reader's own picture in a figure that takes one: chosen, sent to Python, and put back. */

import { message } from "../errors.ts";
import { maybe, one, within } from "../page/dom.ts";
import type { Caller } from "../runtime/runtime.ts";
import type { Photograph } from "./photograph.ts";
import { say } from "./status.ts";

export class OwnPicture {
  #picture: Photograph | null = null;
  /** Number of the interpreter and of the picture that was last sent to it. */
  #sent = "";

  /**
   * @param size Width and height that its scene computes with.
   * @param changed There is another picture, or none any more.
   * @param signal Ends all listening.
   */
  constructor(
    readonly figure: HTMLElement,
    readonly size: [number, number] | null,
    readonly changed: () => void,
    signal: AbortSignal,
  ) {
    const box = maybe(figure, ".photograph", HTMLElement);
    // The menu of the book's pictures leads back to them.
    figure.addEventListener(
      "input",
      (event) => {
        const menu = within(event, "select", HTMLSelectElement);
        if (menu?.name === "picture" && this.#picture) this.#show(null);
      },
      { signal },
    );
    box?.addEventListener("change", (event) => this.#choose(event), { signal });
    box?.addEventListener(
      "click",
      (event) => {
        if (within(event, ".photograph-choose", HTMLElement))
          one(box, "input", HTMLElement).click();
        else if (within(event, "button", HTMLElement)) this.#show(null);
      },
      { signal },
    );
  }

  /** Which picture it is; 0: that of the book. */
  get number() {
    return this.#picture?.number ?? 0;
  }

  /**
   * Send the picture to the interpreter, where that does not have it.
   *
   * @param key The figure's.
   */
  async handOver(runtime: Caller, key: string) {
    const { number = 0, ...picture } = this.#picture ?? {};
    const sending = () => `${runtime.generation} ${number}`;
    if (sending() === this.#sent || (number === 0 && !this.#sent)) return;
    await runtime.call("photograph", { figure: key, number, ...picture }, () => 2);
    this.#sent = sending();
  }

  async #choose(event: Event) {
    const input = within(event, "input", HTMLInputElement);
    const file = input?.files?.[0];
    if (!input || !file || !this.size) return;
    try {
      const { decode } = await import("./photograph.ts");
      const picture = await decode(file, ...this.size);
      if (!this.figure.isConnected) return;
      say(this.figure, "");
      this.#show(picture);
    } catch (error) {
      say(this.figure, message(error));
    } finally {
      input.value = ""; // the same file may be chosen again
    }
  }

  #show(picture: Photograph | null) {
    this.#picture = picture;
    one(this.figure, ".photograph-back", HTMLElement).hidden = !picture;
    one(this.figure, ".photograph-cropped", HTMLElement).hidden = !picture?.cropped;
    this.changed();
  }
}
