/** Handles by keyboard: arrow keys step the controls that a handle drives. */

import { named } from "./controls.js";
import { driven, reversed } from "./handle_elements.js";

/** @import { Control, Value } from "./control_kinds.js" */

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

/**
 * What a key means for the control that it steps; null where it means nothing to the handle.
 *
 * @param {KeyboardEvent} event
 * @param {HTMLElement} element
 * @param {HTMLFormElement} form
 * @param {Control[]} controls
 * @returns {Record<string, Value> | null}
 */
export function keyed(event, element, form, controls) {
  const key = KEYS[event.key];
  if (!key || event.altKey || event.ctrlKey || event.metaKey) return null;
  const names = driven(element);
  const setting = names[Math.min(key.axis, names.length - 1)];
  const control = controls.find(({ name }) => name === setting);
  if (!control) return null;
  const back = Number.isFinite(key.steps) && reversed(element).includes(setting);
  const steps = (back ? -1 : 1) * key.steps * (event.shiftKey ? PAGE : 1);
  return { [setting]: stepped(form, control, steps) };
}

/**
 * A control's value some steps further, or its first or last.
 *
 * @param {HTMLFormElement} form
 * @param {Control} control
 * @param {number} steps
 * @returns {Value}
 */
function stepped(form, control, steps) {
  const field = form.querySelector(named(control.name));
  if (field instanceof HTMLSelectElement) {
    const wanted = Math.max(0, Math.min(field.selectedIndex + steps, field.length - 1));
    return field.options[wanted].value;
  }
  if (control.kind !== "slider") return control.default;
  const wanted = Number(/** @type {HTMLInputElement} */ (field).value) + steps * control.step;
  const digits = control.decimals + 2;
  return Number(Math.max(control.min, Math.min(wanted, control.max)).toFixed(digits));
}
