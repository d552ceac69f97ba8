/**
 * What a figure shows until Python has started: of frames drawn when the book was built, along its
 * main control, the one nearest to where the control stands. They are fetched when the reader points
 * at the figure; on a slow link or device as soon as it is near.
 */

import { savesData } from "../page/data_saver.ts";
import { element, findOptional, find } from "../page/dom.ts";
import { formatValue, setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { readValues, type Schema, type Value } from "./controls.ts";
import type { Place } from "./handles.ts";
import { panelsOf, type FrameMeta, type Painter } from "./painter.ts";

type Frame = FrameMeta & { value: Value; pictures: Record<string, string> };

type Frames = { control: string; frames: Frame[] };

const POINTING_EVENTS = ["pointerenter", "focusin", "touchstart"];
const SLOW = ["slow-2g", "2g", "3g"];
/** Milliseconds from a click to this script, from which a device is slow. */
const LATE_MS = 1500;

const begun = performance.now();

export class Prerendered {
  #frames: Promise<Frames | null> | null = null;
  #listeners = new AbortController();

  readonly figure: HTMLElement;

  /**
   * @param painter The figure's.
   * @param placeHandles Called with the handles of a frame that is shown.
   */
  constructor(
    readonly painter: Painter,
    readonly form: HTMLFormElement,
    readonly schema: Schema,
    readonly placeHandles: (handles: Place[]) => void,
  ) {
    const [figure] = painter.figures;
    this.figure = figure;
    const { signal } = this.#listeners;
    if (!figure.dataset.prerendered) return;
    const options = { signal, once: true, passive: true };
    for (const each of painter.figures) {
      for (const kind of POINTING_EVENTS) each.addEventListener(kind, () => this.#fetch(), options);
    }
    form.addEventListener("input", () => this.#showNearest(), { signal });
    form.addEventListener("change", () => this.#showNearest(), { signal });
  }

  /** The figure is near the window; its controls may have been moved before any script ran. */
  near() {
    if (!this.figure.dataset.prerendered || this.#listeners.signal.aborted) return;
    const [values, initial] = [readValues(this.form, this.schema.controls), this.schema.values];
    if (Object.keys(initial).some((name) => values[name] !== initial[name])) this.#showNearest();
    else if (isSlow()) this.#fetch();
  }

  /** A live frame is there, or the figure has left the page. */
  end() {
    this.#listeners.abort();
    delete this.figure.dataset.early;
    for (const each of this.painter.figures)
      findOptional(each, ".early-mark", HTMLElement)?.remove();
  }

  /** Show the frame nearest to the form's values, where no other control has been moved. */
  async #showNearest() {
    const found = await this.#fetch();
    if (!found || this.#listeners.signal.aborted) return;
    const values = readValues(this.form, this.schema.controls);
    const others = Object.entries(this.schema.values).filter(([name]) => name !== found.control);
    const frame = nearest(found.frames, values[found.control]);
    if (frame && others.every(([name, value]) => values[name] === value)) {
      this.#show(found.control, frame);
    }
  }

  #show(control: string, frame: Frame) {
    const { figure } = this;
    const drawings = frame.panels.map((panel) => ({ ...panel, raster: null }));
    this.painter.paint({ ...frame, panels: drawings }, []);
    for (const [name, address] of Object.entries(frame.pictures)) {
      for (const panel of panelsOf(this.painter.figures, name)) {
        const initial = findOptional(panel, "img.still", HTMLImageElement);
        if (initial) initial.src = address;
      }
    }
    this.placeHandles(frame.handles);
    const text = words("figure.early", { setting: this.#setting(control, frame.value) });
    for (const each of this.painter.figures) {
      setText(find(each, ".description", HTMLElement), frame.description);
      mark(each, text);
    }
    figure.dataset.early = String(frame.value);
  }

  #setting(name: string, value: Value) {
    const control = this.schema.controls.find((one) => one.name === name);
    const text = isSlider(control) ? formatValue(control, Number(value)) : String(value);
    return `${control?.label} ${text}`;
  }

  /** @returns Null where they do not arrive: Python is starting. */
  #fetch(): Promise<Frames | null> {
    const address = this.figure.dataset.prerendered ?? "";
    this.#frames ??= fetch(address)
      .then((reply) => (reply.ok ? reply.json() : null))
      .catch(() => null);
    return this.#frames;
  }
}

/** Say over the first panel of a figure what it shows. */
function mark(figure: HTMLElement, text: string) {
  let mark = findOptional(figure, ".early-mark", HTMLElement);
  if (!mark) {
    mark = element("p", "early-mark box fine");
    find(figure, ".panel", HTMLElement).append(mark);
  }
  mark.textContent = text;
}

/** The frame of the nearest number, or of exactly this option. */
function nearest(frames: Frame[], value: Value): Frame | undefined {
  if (typeof value !== "number") return frames.find((frame) => frame.value === value);
  const distance = (frame: Frame) => Math.abs(Number(frame.value) - value);
  return frames.toSorted((first, second) => distance(first) - distance(second))[0];
}

/** Whether the link or the device is slow; some browsers do not report the link. */
function isSlow() {
  const { connection } = navigator as { connection?: any };
  return !savesData() && (begun > LATE_MS || SLOW.includes(connection?.effectiveType));
}
