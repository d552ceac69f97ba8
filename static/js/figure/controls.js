/**
 * Values of a figure's form, by the schema that Python wrote.
 *
 * @typedef {{title: string, controls: Control[], values: Record<string, Value>, tiers: string[],
 *   default_tier: string, draft_tier: string, drafted: string[],
 *   drafted_in: Record<string, string[]>,
 *   own_drafts: Record<string, Record<string, string>>, photograph: [number, number] | null}} Schema
 */

import { one } from "../page/dom.js";
import { KINDS } from "./control_kinds.js";

/** @import { Control, Value } from "./control_kinds.js" */

/**
 * @param {HTMLFormElement} form
 * @param {Control[]} controls
 * @returns {Record<string, Value>}
 */
export function readValues(form, controls) {
  return Object.fromEntries(controls.map((control) => [control.name, readValue(form, control)]));
}

/**
 * @param {HTMLFormElement} form
 * @param {Control} control
 * @returns {Value}
 */
export function readValue(form, control) {
  return KINDS[control.kind].read(fieldOf(form, control.name), control);
}

/**
 * Move a control from a script.
 *
 * @param {HTMLFormElement} form
 * @param {Control} control
 * @param {Value} value
 */
export function writeValue(form, control, value) {
  KINDS[control.kind].write(fieldOf(form, control.name), control, value);
}

/**
 * Put controls to the values given, as if the reader had moved them: all are written before the
 * first event, so that no frame is requested in between.
 *
 * @param {HTMLFormElement} form
 * @param {Control[]} controls
 * @param {Record<string, Value>} values What is left out stays.
 * @param {"input" | "change"} type `input` while the move goes on, `change` once it is over.
 */
export function moveControls(form, controls, values, type) {
  const moved = controls.filter(({ name }) => name in values);
  for (const control of moved) writeValue(form, control, values[control.name]);
  for (const { name } of moved) {
    form.querySelector(named(name))?.dispatchEvent(new Event(type, { bubbles: true }));
  }
}

/**
 * The native element of a control.
 *
 * @param {HTMLFormElement} form
 * @param {string} name
 */
export function fieldOf(form, name) {
  return one(form, named(name), HTMLElement);
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
