/**
 * Handles: what of a picture can be grabbed. The page knows where a handle is and where the
 * pointer; what a pull means, Python says. It answers with values for controls, and these then
 * move as if the reader had moved them.
 *
 * @typedef {{name: string, x: number, y: number}} Place In view box units of the handle's panel.
 * @typedef {[number, number]} Point
 * @typedef {{handle: string, x: number, y: number, values: string}} Pull
 * @typedef {{handle: string, place: Point, done: boolean}} Job
 */

import { message } from "../errors.js";
import { all, maybe, one, within } from "../page/dom.js";
import { formatValue, moveControls, named, readValues, uncover } from "./controls.js";
import { holdGround, mayScroll } from "./hold.js";
import { LatestWins } from "./scheduler.js";
import { say } from "./status.js";

/** @import { Control, Schema, Value } from "./controls.js" */

/** Handles that are nearer to the pointer than this, in CSS pixels, compete for it. */
const REACH = 22;
/** Steps of a slider that a page key takes at once. */
const PAGE = 10;

/** @type {Record<string, {axis: number, steps: number} | undefined>} */
const KEYS = {
  ArrowRight: { axis: 0, steps: 1 },
  ArrowLeft: { axis: 0, steps: -1 },
  ArrowUp: { axis: 1, steps: 1 },
  ArrowDown: { axis: 1, steps: -1 },
  PageUp: { axis: 1, steps: PAGE },
  PageDown: { axis: 1, steps: -PAGE },
  Home: { axis: 0, steps: -Infinity },
  End: { axis: 0, steps: Infinity },
};

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
      if (!place) continue;
      const { width, height } = viewBox(element);
      element.style.setProperty("--x", `${((100 * place.x) / width).toFixed(3)}%`);
      element.style.setProperty("--y", `${((100 * place.y) / height).toFixed(3)}%`);
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
      if (this.figure.isConnected) say(this.figure, `It stays where it is. (${message(error)})`);
    }
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const element = within(event, "[data-handle]", HTMLElement);
    const key = KEYS[event.key];
    if (!element || !key || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const names = driven(element);
    const setting = names[Math.min(key.axis, names.length - 1)];
    const control = this.schema.controls.find((item) => item.name === setting);
    if (!control) return;
    const back = Number.isFinite(key.steps) && reversed(element).includes(setting);
    const steps = (back ? -1 : 1) * key.steps * (event.shiftKey ? PAGE : 1);
    const values = { [setting]: this.#stepped(control, steps) };
    moveControls(this.form, this.schema.controls, values, "input");
    moveControls(this.form, this.schema.controls, values, "change");
  }

  /**
   * A control's value some steps further, or its first or last.
   *
   * @param {Control} control
   * @param {number} steps
   * @returns {Value}
   */
  #stepped(control, steps) {
    const field = this.form.querySelector(named(control.name));
    if (field instanceof HTMLSelectElement) {
      const wanted = Math.max(0, Math.min(field.selectedIndex + steps, field.length - 1));
      return field.options[wanted].value;
    }
    if (control.kind !== "slider") return control.default;
    const wanted = Number(/** @type {HTMLInputElement} */ (field).value) + steps * control.step;
    const digits = control.decimals + 2;
    return Number(Math.max(control.min, Math.min(wanted, control.max)).toFixed(digits));
  }

  /** Say what each handle is set to. */
  #tell() {
    const values = readValues(this.form, this.schema.controls);
    for (const element of all(this.figure, "[data-handle]", HTMLElement)) {
      const controls = this.schema.controls.filter(({ name }) => driven(element).includes(name));
      const text = controls.map((control) => this.#said(control, values[control.name]));
      const slider = element.getAttribute("role") === "slider";
      if (slider) element.setAttribute("aria-valuenow", this.#now(controls[0]));
      // Only a slider may carry a value at rest; the other kind tells its own while it is used.
      if (slider || element === document.activeElement) {
        element.setAttribute("aria-valuetext", text.join(", "));
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
 * The handle that a press means: the nearest mark within reach, else what lies under it.
 *
 * @param {HTMLElement} layer
 * @param {PointerEvent} event
 * @returns {HTMLElement | null}
 */
function grabbed(layer, event) {
  const near = all(layer, "[data-handle]:not(.drag, .aim, [hidden])", HTMLElement)
    .map((element) => ({ element, distance: distanceTo(element, event) }))
    .filter(({ distance }) => distance <= REACH)
    .sort((a, b) => a.distance - b.distance);
  if (near.length > 0) return near[0].element;
  const ground = within(event, ".handle-ground", HTMLElement)?.dataset.groundOf;
  const target = ground
    ? maybe(layer, `[data-handle="${CSS.escape(ground)}"]`, HTMLElement)
    : within(event, "[data-handle]", HTMLElement);
  return target && !target.hidden ? target : null;
}

/** @param {HTMLElement} element */
function name(element) {
  return element.dataset.handle ?? "";
}

/** @param {HTMLElement} element */
function driven(element) {
  return (element.dataset.drives ?? "").split(" ");
}

/** @param {HTMLElement} element */
function reversed(element) {
  return (element.dataset.reversed ?? "").split(" ");
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

/**
 * The view box of the panel that a handle lies in.
 *
 * @param {HTMLElement} element
 */
function viewBox(element) {
  const view = element.closest(".panel-view") ?? element;
  return one(view, "svg.overlay", SVGSVGElement).viewBox.baseVal;
}

/**
 * Where a pointer is, in view box units of the handle's panel.
 *
 * @param {HTMLElement} element
 * @param {PointerEvent} event
 * @returns {Point}
 */
function inPanel(element, event) {
  const { width, height } = viewBox(element);
  const box = (element.closest(".handles") ?? element).getBoundingClientRect();
  return [
    ((event.clientX - box.left) / box.width) * width,
    ((event.clientY - box.top) / box.height) * height,
  ];
}

/**
 * Where a handle is, in view box units of its panel.
 *
 * @param {HTMLElement} element
 * @returns {Point}
 */
function center(element) {
  const { width, height } = viewBox(element);
  return [
    (Number.parseFloat(element.style.getPropertyValue("--x")) / 100) * width,
    (Number.parseFloat(element.style.getPropertyValue("--y")) / 100) * height,
  ];
}

/**
 * CSS pixels from a handle's mark to the pointer.
 *
 * @param {HTMLElement} element
 * @param {PointerEvent} event
 */
function distanceTo(element, event) {
  const box = element.getBoundingClientRect();
  const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
  return Math.hypot(event.clientX - x, event.clientY - y);
}
