/**
 * Controls as Python describes them, what a kind of them does in the page, the values of a figure's
 * form, and how the address of a page names them.
 */

import { find } from "../page/dom.ts";
import { KINDS } from "./control_kinds.js";

export type Value = number | string | boolean;

/** What all have; kinds add to it. */
export interface Control {
  kind: string;
  name: string;
  label: string;
  default: Value;
}

/** What one kind of control does. `field` is its native element. */
export interface Kind<C extends Control = any, F extends HTMLElement = any> {
  read: (field: F, control: C) => Value;
  write: (field: F, control: C, value: Value) => void;
  /** The value that a text of an address means; undefined where it means none. */
  parse: (control: C, text: string) => Value | undefined;
}

export interface Schema {
  title: string;
  controls: Control[];
  values: Record<string, Value>;
  /** The levels, from cheap to accurate; the level at rest of automatic; and what the menu says at first. */
  tiers: string[];
  default_tier: string;
  tier: string;
  /** Entries of the menu that choose the cheapest level within an error, and that error. */
  within: Record<string, number>;
  /** Milliseconds of frames by level and control, as recorded. */
  recorded: Record<string, Record<string, number>>;
  /** Width and height in pixels, or the most megapixels of one that is not cut. */
  photograph: [number, number] | number | null;
  /** Whether the figure takes the cells of raw files. */
  mosaic: boolean;
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
  return find(form, named(name), HTMLElement);
}

/** Selects the control of that name. */
export function named(name: string) {
  return `[name="${CSS.escape(name)}"]`;
}

/** Unfold what hides one of these controls, so that the reader sees what moves. */
export function unfoldControls(form: HTMLFormElement, names: string[]) {
  for (const name of names) {
    const fold = form.querySelector(named(name))?.closest("details");
    if (fold) fold.open = true;
  }
}

export function prefixOf(figure: HTMLElement) {
  return isEmbed() ? "" : `${figure.closest("figure")?.id}.`;
}

/** Whether the page is a figure's own, for a frame in another page. */
export function isEmbed() {
  return "embed" in document.body.dataset;
}

/** Whether the address sets some of the figure's controls. */
export function isAddressed(figure: HTMLElement) {
  const prefix = prefixOf(figure);
  return [...new URLSearchParams(location.search).keys()].some((key) => key.startsWith(prefix));
}
