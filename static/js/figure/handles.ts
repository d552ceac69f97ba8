/**
 * Handles: what of a picture can be grabbed. The page knows where a handle is and where the
 * pointer; what a pull means, Python says. It answers with values for controls, and these then
 * move as if the reader had moved them.
 */

import { isPoints } from "../../../simulations/engine/controls/points/kind.ts";
import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { message } from "../errors.ts";
import { all, maybe, within } from "../page/dom.ts";
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
  center,
  driven,
  grabbed,
  holdGround,
  inPanel,
  keyed,
  mayScroll,
  movedByKey,
  name,
  placeText,
  put,
  type Point,
} from "./handle_elements.ts";
import { LatestWins } from "./scheduler.ts";
import { say } from "./status.ts";

/** In view box units of the handle's panel. */
export type Place = { name: string; x: number; y: number; step?: number };

export type Pull = { handle: string; x: number; y: number; values: string };

type Job = { handle: string; place: Point; done: boolean };

/** What is in the reader's hand. */
interface Held {
  element: HTMLElement;
  /** How far from the pointer it was taken. */
  offset: Point;
  /** Where it was led. */
  last: Point | null;
  /** Where a finger came down that may be about to scroll. */
  down: PointerEvent | null;
}

export class Handles {
  #held: Held | null = null;
  #pulls: LatestWins<Job> = new LatestWins((job) => this.#pull(job));
  #changes: Changes;
  /** Whether a button has pulled, and the handle that it makes is to get the focus. */
  #byButton = false;

  /** @param signal Ends all listening. */
  constructor(
    readonly figure: HTMLElement,
    readonly form: HTMLFormElement,
    readonly schema: Schema,
    readonly ask: (pull: Pull) => Promise<{ values: Record<string, Value> }>,
    signal: AbortSignal,
  ) {
    for (const layer of all(figure, ".handles", HTMLElement)) {
      layer.addEventListener("pointerdown", (event) => this.#press(event, layer), { signal });
      layer.addEventListener("pointermove", (event) => this.#move(event), { signal });
      layer.addEventListener("pointerup", (event) => this.#release(event), { signal });
      layer.addEventListener("pointercancel", () => this.#letGo(), { signal });
      layer.addEventListener("keydown", (event) => this.#key(event), { signal });
      for (const kind of ["pointerover", "pointerout", "focusin", "focusout"]) {
        layer.addEventListener(kind, (event) => this.#point(event), { signal });
      }
      holdGround(layer, signal);
    }
    form.addEventListener("input", () => this.#describe(), { signal });
    form.addEventListener("click", (event) => this.#pressed(event), { signal });
    this.#changes = new Changes(form, schema.controls, signal);
  }

  /** A frame was painted: put the handles where it has them; the first new one by a button is led on. */
  show(places: Place[]) {
    for (const element of this.#elements) {
      const place = places.find((place) => place.name === name(element));
      const isNew = element.hidden && !!place;
      element.hidden = !place;
      if (place) put(element, place);
      if (isNew && this.#byButton) {
        this.#byButton = false;
        element.focus({ preventScroll: true });
      }
    }
    this.#describe();
  }

  get #elements() {
    return all(this.figure, "[data-handle]", HTMLElement);
  }

  #press(event: PointerEvent, layer: HTMLElement) {
    if (event.button !== 0 || !event.isPrimary || this.#held) return;
    const element = grabbed(layer, event);
    if (!element) return;
    const free = !!within(event, ".handle-ground, .handle.aim", HTMLElement);
    const place = center(element);
    const pointer = inPanel(element, event);
    const offset: Point = free ? [0, 0] : [place[0] - pointer[0], place[1] - pointer[1]];
    const ground = free || element.matches(".drag");
    const down = event.pointerType === "touch" && ground ? event : null;
    this.#held = { element, offset, last: null, down };
    element.classList.add("held", "by-hand");
    layer.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    if (down && free) return;
    event.preventDefault();
    if (free) this.#reach(event);
  }

  #move(event: PointerEvent) {
    if (!this.#held || (this.#held.down && mayScroll(this.#held.down, event))) return;
    this.#held.down = null;
    this.#reach(event);
  }

  /** Bring what is held to the pointer. */
  #reach(event: PointerEvent) {
    if (!this.#held) return;
    const { element, offset } = this.#held;
    const pointer = inPanel(element, event);
    this.#held.last = [pointer[0] + offset[0], pointer[1] + offset[1]];
    this.#pulls.submit({ handle: name(element), place: this.#held.last, done: false });
  }

  #release(event: PointerEvent) {
    if (this.#held?.last || event.pointerType === "touch") this.#reach(event);
    this.#letGo();
  }

  #letGo() {
    if (!this.#held) return;
    const { element, last } = this.#held;
    element.classList.remove("held");
    this.#held = null;
    if (last) this.#pulls.submit({ handle: name(element), place: last, done: true });
  }

  async #pull({ handle, place: [x, y], done }: Job) {
    const { figure, form } = this;
    const { controls } = this.schema;
    try {
      const sent = readValues(form, controls);
      const { values } = await this.ask({ handle, x, y, values: JSON.stringify(sent) });
      if (!figure.isConnected) return;
      const changed = Object.entries(values).filter(([key, value]) => value !== sent[key]);
      moveControls(form, controls, Object.fromEntries(changed), "input");
      if (done) moveControls(form, controls, values, "change");
    } catch (error) {
      if (figure.isConnected) say(figure, words("figure.stays", { reason: message(error) }));
    }
  }

  #key(event: KeyboardEvent) {
    const element = within(event, "[data-handle]", HTMLElement);
    const { controls } = this.schema;
    const place = element && movedByKey(event, element);
    if (place) {
      event.preventDefault();
      element.classList.remove("by-hand");
      this.#pulls.submit({ handle: name(element), place, done: true });
      return;
    }
    const values = element && keyed(event, element, this.form, controls);
    if (!values) return;
    event.preventDefault();
    element.classList.remove("by-hand");
    moveControls(this.form, controls, values, "input");
    moveControls(this.form, controls, values, "change");
  }

  /** A button that pulls a handle, or takes a change of points back. */
  #pressed(event: Event) {
    const handle = within(event, "[data-pull]", HTMLElement)?.dataset.pull;
    this.#byButton = !!handle;
    if (handle) this.#pulls.submit({ handle, place: [0, 0], done: true });
    const undone = within(event, "[data-undo]", HTMLElement)?.dataset.undo;
    if (undone) this.#changes.undo(undone);
  }

  /** Have each handle say what it is set to. */
  #describe() {
    const values = readValues(this.form, this.schema.controls);
    for (const element of this.#elements) {
      const controls = this.schema.controls.filter(({ name }) => driven(element).includes(name));
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
    const element = within(event, "[data-handle]", HTMLElement);
    const begun = event.type === "pointerover" || event.type === "focusin";
    for (const setting of element ? driven(element) : []) {
      const box = this.form.querySelector(named(setting))?.closest(".control");
      box?.classList.toggle("driven", begun);
    }
    // A browser may show the focus that a hand has left, as if by keyboard.
    if (event.type === "focusout") element?.classList.remove("by-hand");
    if (event.type.startsWith("focus")) this.#describe();
  }
}

/** The changes of the points of a figure, which a button takes back one by one. */
class Changes {
  /** Values that the controls had, the last one being the present. */
  #had: Map<string, Value[]> = new Map();

  constructor(
    readonly form: HTMLFormElement,
    readonly controls: Control[],
    signal: AbortSignal,
  ) {
    const points = controls.filter(isPoints);
    for (const control of points) this.#had.set(control.name, [readValue(form, control)]);
    if (points.length)
      form.addEventListener("change", () => points.forEach(this.#keep), { signal });
  }

  undo(name: string) {
    const had = this.#had.get(name) ?? [];
    if (had.length < 2) return;
    had.pop();
    moveControls(this.form, this.controls, { [name]: had[had.length - 1] }, "change");
  }

  #keep = (control: Control) => {
    const had = this.#had.get(control.name) ?? [];
    const now = readValue(this.form, control);
    if (now !== had[had.length - 1]) had.push(now);
    const button = maybe(this.form, `[data-undo="${control.name}"]`, HTMLButtonElement);
    if (button) button.disabled = had.length < 2;
  };
}
