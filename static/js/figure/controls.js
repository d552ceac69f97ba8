/**
 * Values of a figure's form, by the schema that Python wrote.
 *
 * @typedef {{kind: "slider", name: string, label: string, default: number, min: number,
 *   max: number, step: number, unit: string, prefix: string, decimals: number}} Slider
 * @typedef {{kind: "choice", name: string, label: string, default: string,
 *   options: string[]}} Choice
 * @typedef {{kind: "toggle", name: string, label: string, default: boolean}} Toggle
 * @typedef {{kind: "action", name: string, label: string, default: number, labels: string[],
 *   drives: string, effect: string, seconds: number}} Action
 * @typedef {Slider | Choice | Toggle | Action} Control
 * @typedef {number | string | boolean} Value
 * @typedef {{title: string, controls: Control[], values: Record<string, Value>, tiers: string[],
 *   default_tier: string, draft_tier: string, drafted: string[],
 *   drafted_in: Record<string, string[]>,
 *   own_drafts: Record<string, Record<string, string>>, photograph: [number, number] | null}} Schema
 */

import { one } from "../page/dom.js";
import { setText, withUnit } from "../page/text.js";
import { numeral } from "../page/words.js";

/**
 * @param {HTMLFormElement} form
 * @param {Control[]} controls
 * @returns {Record<string, Value>}
 */
export function readValues(form, controls) {
  return Object.fromEntries(controls.map((control) => [control.name, read(form, control)]));
}

/**
 * @param {HTMLFormElement} form
 * @param {Control} control
 * @returns {Value}
 */
function read(form, control) {
  switch (control.kind) {
    case "slider":
      return input(form, control.name).valueAsNumber;
    case "toggle":
      return input(form, control.name).checked;
    case "action": {
      const state = actionState(button(form, control.name));
      return control.labels[state] === undefined ? 0 : state;
    }
    case "choice":
      return chosen(choice(form, control.name), control.options, control.default);
  }
}

/**
 * What a menu says. Where a script has it say what nobody could choose, it is put back.
 *
 * @param {HTMLSelectElement} menu
 * @param {string[]} options
 * @param {string} otherwise
 */
export function chosen(menu, options, otherwise) {
  if (!options.includes(menu.value)) menu.value = otherwise;
  return menu.value;
}

/**
 * The slider or check box of that name.
 *
 * @param {HTMLFormElement} form
 * @param {string} name
 */
export function input(form, name) {
  return one(form, named(name), HTMLInputElement);
}

/**
 * The menu of that name.
 *
 * @param {HTMLFormElement} form
 * @param {string} name
 */
export function choice(form, name) {
  return one(form, named(name), HTMLSelectElement);
}

/**
 * The button of that name.
 *
 * @param {HTMLFormElement} form
 * @param {string} name
 */
export function button(form, name) {
  return one(form, named(name), HTMLButtonElement);
}

/**
 * Selects the control of that name.
 *
 * @param {string} name
 */
export function named(name) {
  return `[name="${CSS.escape(name)}"]`;
}

/**
 * Move a slider from a script and show its value.
 *
 * @param {HTMLFormElement} form
 * @param {Slider} slider
 * @param {number} value
 */
export function writeSlider(form, slider, value) {
  input(form, slider.name).value = String(value);
  showSliderValue(form, slider);
}

/**
 * Put controls to the values given, as if the reader had moved them: all are written before the
 * first tells of it, so that no frame is asked for in between.
 *
 * @param {HTMLFormElement} form
 * @param {Control[]} controls
 * @param {Record<string, Value>} values What is left out stays.
 * @param {"input" | "change"} told `input` while the move goes on, `change` once it is over.
 */
export function moveControls(form, controls, values, told) {
  const moved = controls.filter(({ name }) => name in values);
  for (const control of moved) write(form, control, values[control.name]);
  for (const { name } of moved) {
    form.querySelector(named(name))?.dispatchEvent(new Event(told, { bubbles: true }));
  }
}

/**
 * Unfold what hides one of these controls, so that the reader sees what moves.
 *
 * @param {HTMLFormElement} form
 * @param {string[]} names
 */
export function uncover(form, names) {
  for (const name of names) {
    const fold = form.querySelector(named(name))?.closest("details");
    if (fold) fold.open = true;
  }
}

/**
 * @param {HTMLFormElement} form
 * @param {Control} control
 * @param {Value} value
 */
function write(form, control, value) {
  switch (control.kind) {
    case "slider":
      writeSlider(form, control, Number(value));
      break;
    case "toggle":
      input(form, control.name).checked = Boolean(value);
      break;
    case "action":
      setActionState(button(form, control.name), control, Number(value));
      break;
    case "choice":
      choice(form, control.name).value = String(value);
      break;
  }
}

/**
 * Write the value beside a slider, and into what a screen reader says of it.
 *
 * @param {HTMLFormElement} form
 * @param {Slider} slider
 */
export function showSliderValue(form, slider) {
  const range = input(form, slider.name);
  const text = formatValue(slider, range.valueAsNumber);
  range.setAttribute("aria-valuetext", text);
  setText(range.closest(".control")?.querySelector(".control-value"), text);
}

/**
 * The button's next label.
 *
 * @param {HTMLFormElement} form
 * @param {Action} action
 */
export function pressAction(form, action) {
  const pressed = button(form, action.name);
  setActionState(pressed, action, (actionState(pressed) + 1) % action.labels.length);
}

/**
 * @param {HTMLButtonElement} pressed
 * @param {Action} action
 * @param {number} state
 */
export function setActionState(pressed, action, state) {
  pressed.dataset.state = String(state);
  pressed.textContent = action.labels[state];
}

/** @param {HTMLButtonElement} pressed */
function actionState(pressed) {
  return Number(pressed.dataset.state ?? 0);
}

/**
 * `f/2.8`, `5.0 m`, `30°`, with a true minus sign.
 *
 * @param {{decimals?: number, prefix?: string, unit?: string}} slider
 * @param {number} value
 */
export function formatValue(slider, value) {
  const number = value.toFixed(slider.decimals ?? 0);
  const signed = Number(number) === 0 ? number.replace("-", "") : number.replace("-", "\u2212");
  return withUnit(`${slider.prefix ?? ""}${numeral(signed)}`, slider.unit ?? "");
}
