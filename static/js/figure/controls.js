/**
 * Values of a figure's form, by the schema that Python wrote.
 *
 * @typedef {{name: string, kind: "slider" | "choice" | "toggle" | "action", label: string,
 *   default: any, min?: number, max?: number, step?: number, unit?: string, prefix?: string,
 *   decimals?: number, labels?: string[], drives?: string, effect?: string,
 *   seconds?: number}} Control
 * @typedef {{title: string, controls: Control[], values: Record<string, any>, tiers: string[],
 *   default_tier: string, draft_tier: string, drafted: string[],
 *   drafted_in: Record<string, string[]>}} Schema
 */

import { setText, withUnit } from "./text.js";

/** @param {HTMLFormElement} form @param {Control[]} controls @returns {Record<string, any>} */
export function readValues(form, controls) {
  return Object.fromEntries(controls.map((control) => [control.name, read(form, control)]));
}

/** @param {HTMLFormElement} form @param {Control} control */
function read(form, control) {
  const element = controlElement(form, control.name);
  switch (control.kind) {
    case "slider":
      return element.valueAsNumber;
    case "toggle":
      return element.checked;
    case "action":
      return Number(element.dataset.state ?? 0);
    default:
      return element.value;
  }
}

/** @param {HTMLFormElement} form @param {string} name @returns {any} */
export function controlElement(form, name) {
  const element = form.querySelector(`[name="${CSS.escape(name)}"]`);
  if (!element) throw new Error(`the figure has no control "${name}"`);
  return element;
}

/** Move a slider from a script and show its value. */
export function writeSlider(form, control, value) {
  const input = controlElement(form, control.name);
  input.value = String(value);
  showSliderValue(form, control);
}

/** Write the value beside a slider, and into what a screen reader says of it. */
export function showSliderValue(form, control) {
  const input = controlElement(form, control.name);
  const text = formatValue(control, input.valueAsNumber);
  input.setAttribute("aria-valuetext", text);
  setText(input.closest(".control")?.querySelector(".control-value"), text);
}

/** The button's next label. */
export function pressAction(form, control) {
  const button = controlElement(form, control.name);
  setActionState(button, control, (Number(button.dataset.state ?? 0) + 1) % control.labels.length);
}

/** @param {HTMLButtonElement} button @param {Control} control @param {number} state */
export function setActionState(button, control, state) {
  button.dataset.state = String(state);
  button.textContent = control.labels[state];
}

/** `f/2.8`, `5.0 m`, `30°`, with a true minus sign. */
export function formatValue(control, value) {
  const number = value.toFixed(control.decimals ?? 0);
  const signed = Number(number) === 0 ? number.replace("-", "") : number.replace("-", "\u2212");
  return withUnit(`${control.prefix ?? ""}${signed}`, control.unit ?? "");
}
