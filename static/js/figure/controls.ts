/** Values of a figure's form, by the schema that Python wrote. */

import { one } from "../page/dom.ts";
import { KINDS } from "./control_kinds.js";
import type { Control, Value } from "./control.ts";

export interface Schema {
  title: string;
  controls: Control[];
  values: Record<string, Value>;
  tiers: string[];
  default_tier: string;
  draft_tier: string;
  drafted: string[];
  drafted_in: Record<string, string[]>;
  own_drafts: Record<string, Record<string, string>>;
  /** Width and height in pixels, or the most megapixels of one that is not cut. */
  photograph: [number, number] | number | null;
}

export function readValues(form: HTMLFormElement, controls: Control[]): Record<string, Value> {
  return Object.fromEntries(controls.map((control) => [control.name, readValue(form, control)]));
}

export function readValue(form: HTMLFormElement, control: Control): Value {
  return KINDS[control.kind].read(fieldOf(form, control.name), control);
}

/** Move a control from a script. */
export function writeValue(form: HTMLFormElement, control: Control, value: Value) {
  KINDS[control.kind].write(fieldOf(form, control.name), control, value);
}

/**
 * Put controls to the values given, as if the reader had moved them: all are written before the
 * first event, so that no frame is requested in between.
 *
 * @param values What is left out stays.
 * @param type `input` while the move goes on, `change` once it is over.
 */
export function moveControls(
  form: HTMLFormElement,
  controls: Control[],
  values: Record<string, Value>,
  type: "input" | "change",
) {
  const moved = controls.filter(({ name }) => name in values);
  for (const control of moved) writeValue(form, control, values[control.name]);
  for (const { name } of moved) {
    form.querySelector(named(name))?.dispatchEvent(new Event(type, { bubbles: true }));
  }
}

/** The native element of a control. */
export function fieldOf(form: HTMLFormElement, name: string) {
  return one(form, named(name), HTMLElement);
}

/** Selects the control of that name. */
export function named(name: string) {
  return `[name="${CSS.escape(name)}"]`;
}

/** Unfold what hides one of these controls, so that the reader sees what moves. */
export function uncover(form: HTMLFormElement, names: string[]) {
  for (const name of names) {
    const fold = form.querySelector(named(name))?.closest("details");
    if (fold) fold.open = true;
  }
}
