/**
 * Buttons that move a slider: play sweeps it to its end, step goes to the next whole number,
 * reset returns it to where the page put it.
 */

import { controlElement, setActionState, writeSlider } from "./controls.js";

/** @typedef {import("./controls.js").Control} Control */

/** Shortest pause between two pictures where the reader asked for less motion, in seconds. */
const CALM_PAUSE = 1;
/** Pictures on a way that is too short for whole numbers. */
const CALM_PICTURES = 4;

export class Motion {
  /** @type {{button: HTMLButtonElement, action: Control, stop: () => void} | null} */
  #playing = null;

  /**
   * @param {HTMLFormElement} form
   * @param {import("./controls.js").Schema} schema
   * @param {(moving: boolean, time: number) => void} moved Called after each move of a slider.
   */
  constructor(form, schema, moved) {
    this.form = form;
    this.schema = schema;
    this.moved = moved;
  }

  /** @param {Control} action The button that was pressed. @param {number} time */
  press(action, time) {
    const slider = this.schema.controls.find((control) => control.name === action.drives);
    const wasPlaying = this.#playing?.action === action;
    this.stop();
    if (action.effect === "play") {
      if (!wasPlaying) this.#play(action, slider);
      return;
    }
    const target =
      action.effect === "step" ? this.#next(slider, 1) : this.schema.values[slider.name];
    writeSlider(this.form, slider, target);
    this.moved(false, time);
  }

  /** Stop playing, if it is. */
  stop() {
    if (!this.#playing) return;
    const { button, action, stop } = this.#playing;
    this.#playing = null;
    stop();
    setActionState(button, action, 0);
    this.moved(false, performance.now());
  }

  /** The place after the slider's value, of those a stride apart; past the end it starts over. */
  #next(/** @type {Control} */ slider, /** @type {number} */ stride) {
    const value = controlElement(this.form, slider.name).valueAsNumber;
    if (value >= slider.max) return slider.min;
    const passed = Math.floor((value - slider.min) / stride + 1e-9);
    return Math.min(slider.min + (passed + 1) * stride, slider.max);
  }

  #play(/** @type {Control} */ action, /** @type {Control} */ slider) {
    const button = controlElement(this.form, action.name);
    const input = controlElement(this.form, slider.name);
    if (input.valueAsNumber >= slider.max) writeSlider(this.form, slider, slider.min);
    setActionState(button, action, action.labels.length > 1 ? 1 : 0);
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const stop = calm ? this.#walk(action, slider) : this.#sweep(action, slider);
    this.#playing = { button, action, stop };
  }

  /** Continuous motion, a step of the slider at a time. @returns {() => void} */
  #sweep(action, slider) {
    const start = controlElement(this.form, slider.name).valueAsNumber;
    const perMs = (slider.max - slider.min) / (action.seconds * 1000);
    let begun = 0;
    let request = requestAnimationFrame(function tick(now) {
      begun ||= now;
      request = requestAnimationFrame(tick);
      advance(start + (now - begun) * perMs, now);
    });
    const advance = (value, now) => this.#moveTo(slider, value, now);
    return () => cancelAnimationFrame(request);
  }

  /** One picture after another, the first at once, with time to look. @returns {() => void} */
  #walk(action, slider) {
    const way = slider.max - slider.min;
    const stride = Math.min(1, way / CALM_PICTURES);
    const pause = Math.max(CALM_PAUSE, (action.seconds * stride) / way);
    let timer = setTimeout(function tick() {
      timer = setTimeout(tick, pause * 1000);
      advance();
    });
    const advance = () => this.#moveTo(slider, this.#next(slider, stride), performance.now());
    return () => clearTimeout(timer);
  }

  #moveTo(slider, value, time) {
    const input = controlElement(this.form, slider.name);
    const before = input.value;
    writeSlider(this.form, slider, Math.min(value, slider.max));
    if (input.valueAsNumber >= slider.max) this.stop();
    else if (input.value !== before) this.moved(true, time);
  }
}
