/**
 * What a figure shows until Python has started: of frames that were drawn when the book was built,
 * along its main control, the one nearest to where the control stands. They are fetched when the
 * reader's hand comes near; on a slow link as soon as the figure does.
 */

import { maybe, one } from "../page/dom.js";
import { words } from "../page/words.js";
import { formatValue, readValues } from "./controls.js";

/** @import { Schema, Value } from "./controls.js" */
/** @import { Place } from "./handles.js" */
/** @import { Meta, Painter } from "./painter.js" */
/** @typedef {Meta & {value: Value, pictures: Record<string, string>}} Frame */
/** @typedef {{control: string, frames: Frame[]}} Strip */

const HAND = ["pointerenter", "focusin", "touchstart"];
const SLOW = ["slow-2g", "2g", "3g"];

export class Early {
  /** @type {Promise<Strip | null> | null} */
  #strip = null;
  #over = new AbortController();

  /**
   * @param {Painter} painter The figure's.
   * @param {HTMLFormElement} form
   * @param {Schema} schema
   * @param {(handles: Place[]) => void} place Told where the handles of a shown frame are.
   */
  constructor(painter, form, schema, place) {
    const { figure } = painter;
    this.figure = figure;
    this.painter = painter;
    this.form = form;
    this.schema = schema;
    this.place = place;
    const { signal } = this.#over;
    if (!figure.dataset.strip) return;
    const options = { signal, once: true, passive: true };
    for (const kind of HAND) figure.addEventListener(kind, () => this.#fetched(), options);
    form.addEventListener("input", () => this.#follow(), { signal });
    form.addEventListener("change", () => this.#follow(), { signal });
  }

  /** The figure has come near. */
  near() {
    if (this.figure.dataset.strip && isSlow()) this.#fetched();
  }

  /** A live frame is there, or the figure has left the page. */
  end() {
    this.#over.abort();
    delete this.figure.dataset.early;
    maybe(this.figure, ".early-mark", HTMLElement)?.remove();
  }

  /** Show what is nearest to the form's present values, if the strip tells of them. */
  async #follow() {
    const strip = await this.#fetched();
    if (!strip || this.#over.signal.aborted) return;
    const values = readValues(this.form, this.schema.controls);
    const others = Object.entries(this.schema.values).filter(([name]) => name !== strip.control);
    const frame = nearest(strip.frames, values[strip.control]);
    if (frame && others.every(([name, value]) => values[name] === value)) this.#show(strip, frame);
  }

  /**
   * @param {Strip} strip
   * @param {Frame} frame
   */
  #show({ control }, frame) {
    const { figure } = this;
    const bare = frame.panels.map((panel) => ({ ...panel, raster: null }));
    this.painter.paint({ ...frame, panels: bare }, []);
    for (const [name, address] of Object.entries(frame.pictures)) {
      const panel = one(figure, `.panel[data-panel="${CSS.escape(name)}"]`, HTMLElement);
      const still = maybe(panel, "img.still", HTMLImageElement);
      if (still) still.src = address;
    }
    this.place(frame.handles);
    one(figure, ".description", HTMLElement).textContent = frame.description;
    this.#mark(words("figure.early", { setting: this.#worded(control, frame.value) }));
    figure.dataset.early = String(frame.value);
  }

  /**
   * @param {string} name
   * @param {Value} value
   */
  #worded(name, value) {
    const control = this.schema.controls.find((one) => one.name === name);
    const text = control?.kind === "slider" ? formatValue(control, Number(value)) : String(value);
    return `${control?.label} ${text}`;
  }

  /** @param {string} text */
  #mark(text) {
    let mark = maybe(this.figure, ".early-mark", HTMLElement);
    if (!mark) {
      mark = document.createElement("p");
      mark.className = "early-mark";
      one(this.figure, ".panels", HTMLElement).append(mark);
    }
    mark.textContent = text;
  }

  /** @returns {Promise<Strip | null>} Nothing where it cannot be had: Python is on its way. */
  #fetched() {
    this.#strip ??= fetch(this.figure.dataset.strip ?? "", { signal: this.#over.signal })
      .then((reply) => (reply.ok ? reply.json() : null))
      .catch(() => null);
    return this.#strip;
  }
}

/**
 * The frame of the nearest number, or of just this option.
 *
 * @param {Frame[]} frames
 * @param {Value} value
 * @returns {Frame | undefined}
 */
function nearest(frames, value) {
  if (typeof value !== "number") return frames.find((frame) => frame.value === value);
  const away = (/** @type {Frame} */ frame) => Math.abs(Number(frame.value) - value);
  return frames.reduce((best, frame) => (away(frame) < away(best) ? frame : best));
}

/** Whether the browser says that the link is slow; some say nothing of it. */
function isSlow() {
  const link = /** @type {{connection?: {effectiveType?: string, saveData?: boolean}}} */ (
    navigator
  ).connection;
  return !link?.saveData && SLOW.includes(link?.effectiveType ?? "");
}
