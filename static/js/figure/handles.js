/**
 * Handles: what of a picture can be grabbed. The page knows where a handle is and where the
 * pointer; what a pull means, Python says. It answers with values for controls, and these then
 * move as if the reader had moved them.
 *
 * @typedef {{name: string, x: number, y: number}} Place In view box units of the handle's panel.
 * @typedef {{handle: string, x: number, y: number, values: string}} Pull
 * @typedef {{handle: string, place: Point, done: boolean}} Job
 */

import { message } from "../errors.js";
import { all, within } from "../page/dom.js";
import { setAttribute } from "../page/text.js";
import { formatValue, moveControls, named, readValues, uncover } from "./controls.js";
import { center, driven, grabbed, inPanel, name, put } from "./handle_elements.js";
import { keyed } from "./handle_keys.js";
import { holdGround, mayScroll } from "./pointer_capture.js";
import { LatestWins } from "./scheduler.js";
import { say } from "./status.js";
import { words } from "../page/words.js";

/** @import { Control, Schema, Value } from "./controls.js" */
/** @import { Point } from "./handle_elements.js" */

export class Handles {
  /**
   * What is in the reader's hand, how far from the pointer it was taken, and where it was led; of
   * a finger that may still be on its way to scroll the page, where it came down.
   *
   * @type {{element: HTMLElement, offset: Point, last: Point | null, down: PointerEvent | null}
   *   | null}
   */
  #held = null;
  /** @type {LatestWins<Job>} */
  #pulls = new LatestWins((job) => this.#pull(job));

  /**
   * @param {HTMLElement} figure
   * @param {HTMLFormElement} form
   * @param {Schema} schema
   * @param {(pull: Pull) => Promise<{values: Record<string, Value>}>} ask
   * @param {AbortSignal} signal Ends all listening.
   */
  constructor(figure, form, schema, ask, signal) {
    this.figure = figure;
    this.form = form;
    this.schema = schema;
    this.ask = ask;
    for (const layer of all(figure, ".handles", HTMLElement)) {
      layer.addEventListener("pointerdown", (event) => this.#press(event), { signal });
      layer.addEventListener("pointermove", (event) => this.#move(event), { signal });
      layer.addEventListener("pointerup", (event) => this.#release(event), { signal });
      layer.addEventListener("pointercancel", () => this.#letGo(), { signal });
      layer.addEventListener("keydown", (event) => this.#key(event), { signal });
      for (const kind of ["pointerover", "pointerout", "focusin", "focusout"]) {
        layer.addEventListener(kind, (event) => this.#point(event), { signal });
      }
      holdGround(layer, signal);
    }
    form.addEventListener("input", () => this.#tell(), { signal });
  }

  /**
   * A frame was painted: put the handles where it has them.
   *
   * @param {Place[]} places
   */
  show(places) {
    const found = new Map(places.map((place) => [place.name, place]));
    for (const element of all(this.figure, "[data-handle]", HTMLElement)) {
      const place = found.get(element.dataset.handle ?? "");
      element.hidden = !place;
      if (place) put(element, place);
    }
    this.#tell();
  }

  /** @param {PointerEvent} event */
  #press(event) {
    const layer = within(event, ".handles", HTMLElement);
    if (event.button !== 0 || !event.isPrimary || this.#held || !layer) return;
    const element = grabbed(layer, event);
    if (!element) return;
    const free = !!within(event, ".handle-ground, .handle.aim", HTMLElement);
    const place = center(element);
    const pointer = inPanel(element, event);
    const offset = /** @type {Point} */ (
      free ? [0, 0] : [place[0] - pointer[0], place[1] - pointer[1]]
    );
    const ground = free || element.matches(".drag");
    const down = event.pointerType === "touch" && ground ? event : null;
    this.#held = { element, offset, last: null, down };
    element.classList.add("held");
    layer.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    if (down && free) return;
    event.preventDefault();
    if (free) this.#reach(event);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    if (!this.#held || (this.#held.down && mayScroll(this.#held.down, event))) return;
    this.#held.down = null;
    this.#reach(event);
  }

  /**
   * Bring what is held to the pointer.
   *
   * @param {PointerEvent} event
   */
  #reach(event) {
    if (!this.#held) return;
    const { element, offset } = this.#held;
    const pointer = inPanel(element, event);
    const place = /** @type {Point} */ ([pointer[0] + offset[0], pointer[1] + offset[1]]);
    this.#held.last = place;
    this.#pulls.submit({ handle: name(element), place, done: false });
  }

  /** @param {PointerEvent} event */
  #release(event) {
    if (!this.#held) return;
    if (this.#held.last || event.pointerType === "touch") this.#reach(event);
    this.#letGo();
  }

  #letGo() {
    if (!this.#held) return;
    const { element, last } = this.#held;
    element.classList.remove("held");
    this.#held = null;
    if (last) this.#pulls.submit({ handle: name(element), place: last, done: true });
  }

  /** @param {Job} job */
  async #pull({ handle, place: [x, y], done }) {
    const { controls } = this.schema;
    try {
      const values = JSON.stringify(readValues(this.form, controls));
      const reply = await this.ask({ handle, x, y, values });
      if (!this.figure.isConnected) return;
      moveControls(this.form, controls, changed(reply.values, values), "input");
      if (done) moveControls(this.form, controls, reply.values, "change");
    } catch (error) {
      if (this.figure.isConnected)
        say(this.figure, words("figure.stays", { reason: message(error) }));
    }
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const element = within(event, "[data-handle]", HTMLElement);
    const { controls } = this.schema;
    const values = element && keyed(event, element, this.form, controls);
    if (!values) return;
    event.preventDefault();
    moveControls(this.form, controls, values, "input");
    moveControls(this.form, controls, values, "change");
  }

  /** Say what each handle is set to. */
  #tell() {
    const values = readValues(this.form, this.schema.controls);
    for (const element of all(this.figure, "[data-handle]", HTMLElement)) {
      const controls = this.schema.controls.filter(({ name }) => driven(element).includes(name));
      const text = controls.map((control) => this.#said(control, values[control.name]));
      const slider = element.getAttribute("role") === "slider";
      if (slider) setAttribute(element, "aria-valuenow", this.#now(controls[0]));
      // Only a slider may carry a value at rest; the other kind tells its own while it is used.
      if (slider || element === document.activeElement) {
        setAttribute(element, "aria-valuetext", text.join(", "));
      } else {
        element.removeAttribute("aria-valuetext");
      }
    }
  }

  /**
   * @param {Control} control
   * @param {Value} value
   */
  #said(control, value) {
    if (control.kind === "slider") return `${control.label} ${formatValue(control, Number(value))}`;
    const field = this.form.querySelector(named(control.name));
    const chosen = field instanceof HTMLSelectElement ? field.selectedOptions[0]?.text.trim() : "";
    return `${control.label} ${chosen}`;
  }

  /** @param {Control} control */
  #now(control) {
    const field = this.form.querySelector(named(control.name));
    if (field instanceof HTMLSelectElement) return String(field.selectedIndex);
    return field instanceof HTMLInputElement ? field.value : "0";
  }

  /**
   * Mark the controls that a handle drives while it is pointed at or focused.
   *
   * @param {Event} event
   */
  #point(event) {
    const element = within(event, "[data-handle]", HTMLElement);
    const begun = event.type === "pointerover" || event.type === "focusin";
    for (const setting of element ? driven(element) : []) {
      const box = this.form.querySelector(named(setting))?.closest(".control");
      box?.classList.toggle("driven", begun);
    }
    if (element && event.type === "focusin") uncover(this.form, driven(element));
    if (event.type.startsWith("focus")) this.#tell();
  }
}

/**
 * What of the values differs from those that were sent.
 *
 * @param {Record<string, Value>} values
 * @param {string} sent
 */
function changed(values, sent) {
  const before = JSON.parse(sent);
  return Object.fromEntries(Object.entries(values).filter(([key, value]) => value !== before[key]));
}
