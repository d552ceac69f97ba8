/**
 * Handles: the parts of a picture that can be dragged. The page knows where a handle is and where the
 * pointer; Python computes the meaning of a pull. It answers with values for controls, and these then
 * move as if the reader had moved them.
 */

import { isPoints } from "../../../simulations/engine/controls/points/kind.ts";
import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { errorText } from "../errors.ts";
import { findAll, findOptional, closestTo } from "../page/dom.ts";
import { formatValue, setAttribute } from "../page/text.ts";
import { words } from "../page/words.ts";
import {
  type Control,
  moveControls,
  named,
  readValue,
  readValues,
  type Schema,
  type Value,
} from "./controls.ts";
import {
  drivenSettings,
  handleAt,
  installGroundHold,
  handleName,
  handlePlace,
  valuesByKey,
  mayScroll,
  placeByKey,
  placeText,
  placeHandle,
  pointerPlace,
  type Point,
} from "./handle_elements.ts";
import { LatestWins } from "./scheduler.ts";
import { showMessage } from "./status.ts";

/** In view box units of the handle's panel. */
export type Place = { name: string; x: number; y: number; step?: number };

export type Pull = { handle: string; x: number; y: number; values: string };

type Job = { handle: string; place: Point; done: boolean };

/** A handle that is dragged. */
interface Grab {
  element: HTMLElement;
  /** Its distance from the pointer at the press. */
  offset: Point;
  /** Where it was led. */
  last: Point | null;
  /** Where a finger came down that may be about to scroll. */
  down: PointerEvent | null;
}

export class Handles {
  #grab: Grab | null = null;
  #pulls: LatestWins<Job> = new LatestWins((job) => this.#pull(job));
  #history: PointHistory;
  /** Whether a button has pulled, and the handle that it makes is to get the focus. */
  #byButton = false;

  /**
   * @param figures A figure and its parts, whose handles move the form.
   * @param signal Ends all listening.
   */
  constructor(
    readonly figures: HTMLElement[],
    readonly form: HTMLFormElement,
    readonly schema: Schema,
    readonly requestPull: (pull: Pull) => Promise<{ values: Record<string, Value> }>,
    signal: AbortSignal,
  ) {
    for (const layer of figures.flatMap((each) => findAll(each, ".handles", HTMLElement))) {
      layer.addEventListener("pointerdown", (event) => this.#press(event, layer), { signal });
      layer.addEventListener("pointermove", (event) => this.#move(event), { signal });
      layer.addEventListener("pointerup", (event) => this.#release(event), { signal });
      layer.addEventListener("pointercancel", () => this.#letGo(), { signal });
      layer.addEventListener("keydown", (event) => this.#key(event), { signal });
      for (const kind of ["pointerover", "pointerout", "focusin", "focusout"]) {
        layer.addEventListener(kind, (event) => this.#point(event), { signal });
      }
      installGroundHold(layer, signal);
    }
    form.addEventListener("input", () => this.#describe(), { signal });
    form.addEventListener("click", (event) => this.#pressed(event), { signal });
    this.#history = new PointHistory(form, schema.controls, signal);
  }

  /** A frame was painted: put the handles where it has them; the first new one by a button is led on. */
  show(places: Place[]) {
    for (const element of this.#elements) {
      const place = places.find((place) => place.name === handleName(element));
      const isNew = element.hidden && !!place;
      element.hidden = !place;
      if (place) placeHandle(element, place);
      if (isNew && this.#byButton) {
        this.#byButton = false;
        element.focus({ preventScroll: true });
      }
    }
    this.#describe();
  }

  get #elements() {
    return this.figures.flatMap((each) => findAll(each, "[data-handle]", HTMLElement));
  }

  #press(event: PointerEvent, layer: HTMLElement) {
    if (event.button !== 0 || !event.isPrimary || this.#grab) return;
    const element = handleAt(layer, event);
    if (!element) return;
    const free = !!closestTo(event, ".handle-ground, .handle.aim", HTMLElement);
    const place = handlePlace(element);
    const pointer = pointerPlace(element, event);
    const offset: Point = free ? [0, 0] : [place[0] - pointer[0], place[1] - pointer[1]];
    const ground = free || element.matches(".drag");
    const down = event.pointerType === "touch" && ground ? event : null;
    this.#grab = { element, offset, last: null, down };
    element.classList.add("held", "by-hand");
    layer.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    if (down && free) return;
    event.preventDefault();
    if (free) this.#pullToPointer(event);
  }

  #move(event: PointerEvent) {
    if (!this.#grab || (this.#grab.down && mayScroll(this.#grab.down, event))) return;
    this.#grab.down = null;
    this.#pullToPointer(event);
  }

  /** Bring the dragged handle to the pointer. */
  #pullToPointer(event: PointerEvent) {
    if (!this.#grab) return;
    const { element, offset } = this.#grab;
    const pointer = pointerPlace(element, event);
    this.#grab.last = [pointer[0] + offset[0], pointer[1] + offset[1]];
    this.#pulls.submit({ handle: handleName(element), place: this.#grab.last, done: false });
  }

  #release(event: PointerEvent) {
    if (this.#grab?.last || event.pointerType === "touch") this.#pullToPointer(event);
    this.#letGo();
  }

  #letGo() {
    if (!this.#grab) return;
    const { element, last } = this.#grab;
    element.classList.remove("held");
    this.#grab = null;
    if (last) this.#pulls.submit({ handle: handleName(element), place: last, done: true });
  }

  async #pull({ handle, place: [x, y], done }: Job) {
    const { form } = this;
    const [figure] = this.figures;
    const { controls } = this.schema;
    try {
      const sent = readValues(form, controls);
      const { values } = await this.requestPull({ handle, x, y, values: JSON.stringify(sent) });
      if (!figure.isConnected) return;
      const changed = Object.entries(values).filter(([key, value]) => value !== sent[key]);
      moveControls(form, controls, Object.fromEntries(changed), "input");
      if (done) moveControls(form, controls, values, "change");
    } catch (error) {
      if (figure.isConnected)
        showMessage(figure, words("figure.stays", { reason: errorText(error) }));
    }
  }

  #key(event: KeyboardEvent) {
    const element = closestTo(event, "[data-handle]", HTMLElement);
    const { controls } = this.schema;
    const place = element && placeByKey(event, element);
    if (place) {
      event.preventDefault();
      element.classList.remove("by-hand");
      this.#pulls.submit({ handle: handleName(element), place, done: true });
      return;
    }
    const values = element && valuesByKey(event, element, this.form, controls);
    if (!values) return;
    event.preventDefault();
    element.classList.remove("by-hand");
    moveControls(this.form, controls, values, "input");
    moveControls(this.form, controls, values, "change");
  }

  /** A button that pulls a handle, or takes a change of points back. */
  #pressed(event: Event) {
    const handle = closestTo(event, "[data-pull]", HTMLElement)?.dataset.pull;
    this.#byButton = !!handle;
    if (handle) this.#pulls.submit({ handle, place: [0, 0], done: true });
    const undone = closestTo(event, "[data-undo]", HTMLElement)?.dataset.undo;
    if (undone) this.#history.undo(undone);
  }

  /** Describe the value of each handle, for screen readers. */
  #describe() {
    const values = readValues(this.form, this.schema.controls);
    for (const element of this.#elements) {
      const controls = this.schema.controls.filter(({ name }) =>
        drivenSettings(element).includes(name),
      );
      const text = controls.map((control) =>
        isPoints(control)
          ? `${control.label} ${placeText(element)}`
          : this.#valueText(control, values[control.name]),
      );
      const slider = element.role === "slider";
      if (slider) setAttribute(element, "aria-valuenow", this.#number(controls[0]));
      // Only a slider may carry a value at rest; the other kind has one while it is used.
      if (slider || element === document.activeElement) {
        setAttribute(element, "aria-valuetext", text.join(", "));
      } else {
        element.removeAttribute("aria-valuetext");
      }
    }
  }

  #valueText(control: Control, value: Value) {
    if (isSlider(control)) return `${control.label} ${formatValue(control, Number(value))}`;
    const field = this.form.querySelector(named(control.name));
    const chosen = field instanceof HTMLSelectElement ? field.selectedOptions[0]?.text.trim() : "";
    return `${control.label} ${chosen}`;
  }

  #number(control: Control) {
    const field = this.form.querySelector(named(control.name));
    if (field instanceof HTMLSelectElement) return String(field.selectedIndex);
    return field instanceof HTMLInputElement ? field.value : "0";
  }

  /** Mark the controls that a handle drives while it is pointed at or focused. */
  #point(event: Event) {
    const element = closestTo(event, "[data-handle]", HTMLElement);
    const begun = event.type === "pointerover" || event.type === "focusin";
    for (const setting of element ? drivenSettings(element) : []) {
      for (const field of this.figures.flatMap((each) => findAll(each, named(setting), Element))) {
        field.closest(".control")?.classList.toggle("driven", begun);
      }
    }
    // A browser may show the focus that a pointer has left, as if by keyboard.
    if (event.type === "focusout") element?.classList.remove("by-hand");
    if (event.type.startsWith("focus")) this.#describe();
  }
}

/** The changes of the points of a figure, which a button takes back one by one. */
class PointHistory {
  /** Values that the control had, the last one being the present. */
  #values: Map<string, Value[]> = new Map();

  constructor(
    readonly form: HTMLFormElement,
    readonly controls: Control[],
    signal: AbortSignal,
  ) {
    const points = controls.filter(isPoints);
    for (const control of points) this.#values.set(control.name, [readValue(form, control)]);
    if (points.length)
      form.addEventListener("change", () => points.forEach(this.#record), { signal });
  }

  undo(name: string) {
    const values = this.#values.get(name) ?? [];
    if (values.length < 2) return;
    values.pop();
    moveControls(this.form, this.controls, { [name]: values[values.length - 1] }, "change");
  }

  #record = (control: Control) => {
    const values = this.#values.get(control.name) ?? [];
    const now = readValue(this.form, control);
    if (now !== values[values.length - 1]) values.push(now);
    const button = findOptional(this.form, `[data-undo="${control.name}"]`, HTMLButtonElement);
    if (button) button.disabled = values.length < 2;
  };
}
