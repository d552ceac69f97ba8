/** The reader's pictures in a figure that takes them: chosen, sent to Python, and put back. */

import { errorText } from "../errors.ts";
import { findOptional, find, closestTo } from "../page/dom.ts";
import type { Picture, Reading } from "../runtime/messages.ts";
import type { Caller } from "../runtime/runtime.ts";
import type { Schema } from "./controls.ts";
import type { Size, Source } from "./photograph.ts";
import { showMessage } from "./status.ts";

const LARGE_MEGAPIXELS = 4;

/** The picture that is viewed. */
type ChosenPicture = Source & { number: number };

export class ReaderPicture {
  #chosen: ChosenPicture | null = null;
  /** Pixels of the chosen picture, until they are handed over: they are many. */
  #decoded: Picture | null = null;
  #readings: Reading[] = [];
  /** Counts the sets of readings. */
  #version = 0;
  /** Number of the interpreter, and of what was last sent to it. */
  #sent = { picture: "", readings: "" };

  /**
   * @param schema Of a scene that takes no picture, `photograph` is null.
   * @param changed There are other pictures, or none any more.
   * @param signal Ends all listening.
   */
  constructor(
    readonly figure: HTMLElement,
    readonly schema: Pick<Schema, "photograph" | "mosaic">,
    readonly changed: () => void,
    signal: AbortSignal,
  ) {
    const box = findOptional(figure, ".photograph", HTMLElement);
    // The menu of the book's pictures leads back to them.
    figure.addEventListener(
      "input",
      (event) => {
        const menu = closestTo(event, "select", HTMLSelectElement);
        if (box && menu?.name === "picture" && this.#chosen) this.#show(null);
      },
      { signal },
    );
    box?.addEventListener("change", (event) => this.#choose(event), { signal });
    box?.addEventListener(
      "click",
      (event) => {
        if (closestTo(event, ".photograph-choose", HTMLElement))
          find(box, "input", HTMLElement).click();
        else if (closestTo(event, "button", HTMLElement)) this.#show(null);
      },
      { signal },
    );
  }

  /** That its scene computes with; null: it takes no picture. */
  get size(): Size | null {
    return this.schema.photograph;
  }

  /** A key of the pictures; empty for the book's. */
  get key() {
    return this.#chosen || this.#readings.length
      ? `${this.#chosen?.number ?? 0} ${this.#version}`
      : "";
  }

  /** Whether the interpreter has, or had, a photograph that took much memory. */
  get isLarge() {
    return Number(this.size) > LARGE_MEGAPIXELS && this.#sent.picture !== "";
  }

  /** Use the readings of all pictures, and view the chosen one. */
  set(chosen: ChosenPicture | null, readings: Reading[]) {
    this.#chosen = this.size ? chosen : null;
    const numbers = (list: Reading[]) => list.map(({ number }) => number).join();
    if (numbers(readings) !== numbers(this.#readings)) this.#version += 1;
    this.#readings = readings;
    this.changed();
  }

  /** Send the pictures of the figure with this key to the interpreter, where that lacks them. */
  async sendTo(runtime: Caller, figure: string) {
    const number = this.#chosen?.number ?? 0;
    const sending = (what: number) => `${runtime.generation} ${what}`;
    if (sending(number) !== this.#sent.picture && (number || this.#sent.picture)) {
      const picture = await this.#takeDecoded();
      await runtime.call("photograph", { figure, picture }, () => 2);
      this.#sent.picture = sending(number);
    }
    const version = this.#version;
    if (sending(version) !== this.#sent.readings && version) {
      await runtime.call("readings", { figure, readings: this.#readings }, () => 2);
      this.#sent.readings = sending(version);
    }
  }

  /** The chosen picture, to be sent once. */
  async #takeDecoded(): Promise<Picture | null> {
    const [chosen, taken] = [this.#chosen, this.#decoded];
    this.#decoded = null;
    if (!chosen || !this.size) return null;
    if (taken?.number === chosen.number) return taken;
    const { decodePicture } = await import("./photograph.ts");
    return await decodePicture(chosen, chosen.number, this.size, this.schema.mosaic);
  }

  async #choose(event: Event) {
    const input = closestTo(event, "input", HTMLInputElement);
    const file = input?.files?.[0];
    if (!input || !file || !this.size) return;
    try {
      const { decodePicture, isCropped, nextPictureNumber } = await import("./photograph.ts");
      const chosen = { number: nextPictureNumber(), name: file.name, file };
      const picture = await decodePicture(chosen, chosen.number, this.size);
      if (!this.figure.isConnected) return;
      showMessage(this.figure, "");
      this.#decoded = picture;
      this.#show(chosen, isCropped(picture));
    } catch (error) {
      showMessage(this.figure, errorText(error));
    } finally {
      input.value = ""; // the same file may be chosen again
    }
  }

  #show(chosen: ChosenPicture | null, cropped: boolean = false) {
    this.#chosen = chosen;
    find(this.figure, ".photograph-back", HTMLElement).hidden = !chosen;
    find(this.figure, ".photograph-cropped", HTMLElement).hidden = !cropped;
    this.changed();
  }
}
