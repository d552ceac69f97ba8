/**
 * Sliders that move by themselves. Of the buttons that move one, play sweeps it to its end, step goes
 * to the next whole number, reset returns it to where the page put it. Others move as they come into
 * view.
 */

import { find } from "../page/dom.ts";
import { animateShare, prefersReducedMotion } from "./animate.ts";
import { isAction, type Action } from "../../../simulations/engine/controls/action/kind.ts";
import { isSlider, type Slider } from "../../../simulations/engine/controls/slider/kind.ts";
import { readValue, writeValue, type Schema } from "./controls.ts";

/** Shortest pause between two pictures where the reader prefers less motion, in seconds. */
const REDUCED_PAUSE = 1;
/** Pictures on a way that is too short for whole numbers. */
const REDUCED_PICTURES = 4;
/** A way of more whole numbers than these has fewer pictures. */
const MOST_WHOLE = 48;
const REDUCED_MOST = 24;
/** Milliseconds of a slider's way to its `arrival` and back. */
const RETURN_MS = 4000;

export class Motion {
  /** Without an action any touch ends it. */
  #playing: { action: Action | null; slider: Slider; stop: () => void } | null = null;
  /** Whether what plays has begun by itself, and no hand was on the figure since. */
  #byItself = false;

  /** @param moved Called after each move of a slider, with its name and whether the move goes on. */
  constructor(
    readonly form: HTMLFormElement,
    readonly schema: Schema,
    readonly moved: (slider: string, time: number, isMoving: boolean) => void,
  ) {}

  /** @param action The button that was pressed. */
  press(action: Action, time: number) {
    const slider = this.schema.controls.find(({ name }) => name === action.drives);
    if (!isSlider(slider)) throw new Error(`${action.name} drives no slider`);
    const wasPlaying = this.#playing?.action === action;
    this.stop();
    if (action.effect === "play") {
      if (!wasPlaying) this.#play(action, slider);
      return;
    }
    writeValue(this.form, slider, this.#next(slider, 1));
    this.moved(slider.name, time, false);
  }

  /** Stop playing, if it is. */
  stop() {
    if (!this.#playing) return;
    const { action, slider, stop } = this.#playing;
    this.#playing = null;
    stop();
    if (action) writeValue(this.form, action, 0);
    this.moved(slider.name, performance.now(), false);
  }

  /** Undo a motion that began by itself, as it is out of view, so that the text stays true. */
  away() {
    const slider = this.#byItself && this.#playing?.slider;
    if (slider) writeValue(this.form, slider, this.schema.values[slider.name]);
    this.stop();
  }

  /** Begin the motion that a control declares, if neither page nor reader has set it. */
  startByItself() {
    const { controls } = this.schema;
    const action = controls.filter(isAction).find(({ arrival }) => arrival);
    const slider = controls.filter(isSlider).find(({ arrival }) => arrival !== undefined);
    if (action) this.press(action, performance.now());
    else if (slider && this.#value(slider) === slider.default) this.#goAndReturn(slider);
    this.#byItself = true;
  }

  /** Stop a motion that began by itself, as the reader uses the figure. */
  stopByTouch() {
    this.#byItself = false;
    if (this.#playing && !this.#playing.action) this.stop();
  }

  #goAndReturn(slider: Slider) {
    const start = this.#value(slider);
    const range = (slider.arrival ?? start) - start;
    const stop = animateShare(RETURN_MS, (share, now) => {
      writeValue(this.form, slider, start + (range * (1 - Math.cos(2 * Math.PI * share))) / 2);
      if (share < 1) this.moved(slider.name, now, true);
      else this.stop();
    });
    this.#playing = { action: null, slider, stop };
  }

  /** The place after the slider's value, of those a stride apart; past the end it starts over. */
  #next(slider: Slider, stride: number) {
    const value = this.#value(slider);
    if (value >= slider.max) return slider.min;
    const passed = Math.floor((value - slider.min) / stride + 1e-9);
    return Math.min(slider.min + (passed + 1) * stride, slider.max);
  }

  #play(action: Action, slider: Slider) {
    if (this.#value(slider) >= slider.max) writeValue(this.form, slider, slider.min);
    writeValue(this.form, action, action.labels.length > 1 ? 1 : 0);
    const stop = prefersReducedMotion() ? this.#walk(action, slider) : this.#sweep(action, slider);
    this.#playing = { action, slider, stop };
  }

  /** Continuous motion, a step of the slider at a time; what is returned ends it. */
  #sweep(action: Action, slider: Slider): () => void {
    const start = this.#value(slider);
    const range = slider.max - slider.min;
    return animateShare(action.seconds * 1000, (share, now) => {
      this.#moveTo(slider, start + share * range, now);
    });
  }

  /** One picture after another, the first at once, with time to look; what is returned ends it. */
  #walk(action: Action, slider: Slider): () => void {
    const range = slider.max - slider.min;
    const coarse = Math.ceil(range / REDUCED_MOST / slider.step) * slider.step;
    const stride = range > MOST_WHOLE ? coarse : Math.min(1, range / REDUCED_PICTURES);
    const pause = Math.max(REDUCED_PAUSE, (action.seconds * stride) / range);
    const tick = () => {
      timer = setTimeout(tick, pause * 1000);
      this.#moveTo(slider, this.#next(slider, stride), performance.now());
    };
    let timer = setTimeout(tick);
    return () => clearTimeout(timer);
  }

  #moveTo(slider: Slider, value: number, time: number) {
    const before = this.#value(slider);
    writeValue(this.form, slider, Math.min(value, slider.max));
    const now = this.#value(slider);
    if (now >= slider.max) this.stop();
    else if (now !== before) this.moved(slider.name, time, true);
  }

  #value(slider: Slider) {
    return Number(readValue(this.form, slider));
  }
}

/** Share of the panels that must be in view. */
const IN_VIEW = 0.5;

/**
 * Start a figure's motion when it, or a part of it, first comes into view, unless the reader has used it
 * or prefers less motion. All motion stops out of view.
 *
 * @param signal Ends all watching.
 */
export function moveInView(figures: HTMLElement[], motion: Motion, signal: AbortSignal) {
  const [figure] = figures;
  const seen: Map<Element, IntersectionObserverEntry> = new Map();
  let waits = true;
  const begin = () => {
    const inView = [...seen.values()].some((entry) => entry.intersectionRatio >= IN_VIEW);
    // Python has computed a frame of it, and so will keep up with what moves.
    if (!waits || !inView || !Number(figure.dataset.computeMs) || prefersReducedMotion()) return;
    waits = false;
    motion.startByItself();
  };
  const touched = () => {
    waits = false;
    motion.stopByTouch();
  };
  const observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) seen.set(entry.target, entry);
      if ([...seen.values()].some((entry) => entry.isIntersecting)) begin();
      else motion.away();
    },
    { threshold: [0, IN_VIEW] },
  );
  for (const each of figures) observer.observe(find(each, ".panels", HTMLElement));
  signal.addEventListener("abort", () => observer.disconnect());
  figure.addEventListener("painted", begin, { signal });
  for (const type of ["pointerdown", "keydown", "input", "change"]) {
    for (const each of figures) each.addEventListener(type, touched, { signal, capture: true });
  }
}
