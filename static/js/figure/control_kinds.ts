/** What each kind of control does in the page; `readValues` and the like know no kinds. */

import { setText, withUnit } from "../page/text.js";
import { numeral } from "../page/words.js";

/** As Python describes them. */
export interface Slider {
  kind: "slider";
  name: string;
  label: string;
  default: number;
  min: number;
  max: number;
  step: number;
  unit: string;
  prefix: string;
  decimals: number;
}

type Choice = { kind: "choice"; name: string; label: string; default: string; options: string[] };

type Toggle = { kind: "toggle"; name: string; label: string; default: boolean };

export interface Action {
  kind: "action";
  name: string;
  label: string;
  default: number;
  labels: string[];
  drives: string;
  effect: string;
  seconds: number;
}

export type Control = Slider | Choice | Toggle | Action;

export type Value = number | string | boolean;

/** `field` is the native element, `control` its description. */
export interface Kind {
  read: (field: any, control: any) => Value;
  write: (field: any, control: any, value: Value) => void;
  /** The value that a text of an address means; undefined where it means none. */
  parse: (control: any, text: string) => Value | undefined;
}

export const KINDS: Record<Control["kind"], Kind> = {
  slider: {
    read: (field) => field.valueAsNumber,
    write(field, control, value) {
      field.value = String(value); // which the slider brings into its range and onto its steps
      showValue(field, control);
    },
    parse(_control, text) {
      const number = text.trim() === "" ? Number.NaN : Number(text);
      return Number.isFinite(number) ? number : undefined;
    },
  },
  choice: {
    read(field, control) {
      // Where a script has a menu say what nobody could choose, it is put back.
      if (!control.options.includes(field.value)) field.value = control.default;
      return field.value;
    },
    write: (field, _control, value) => (field.value = value),
    parse: (control, text) => (control.options.includes(text) ? text : undefined),
  },
  toggle: {
    read: (field) => field.checked,
    write: (field, _control, value) => (field.checked = Boolean(value)),
    parse: (_control, text) => text === "true" || (text === "false" ? false : undefined),
  },
  action: {
    read(field, control) {
      const state = Number(field.dataset.state ?? 0);
      return control.labels[state] === undefined ? 0 : state;
    },
    write(field, control, value) {
      field.dataset.state = String(value);
      field.textContent = control.labels[Number(value)];
    },
    parse(control, text) {
      const state = text.trim() === "" ? Number.NaN : Number(text);
      return control.labels[state] === undefined ? undefined : state;
    },
  },
};

/** Write the value beside a slider, and into what a screen reader says of it. */
export function showValue(field: HTMLInputElement, slider: Slider) {
  const text = formatValue(slider, field.valueAsNumber);
  field.setAttribute("aria-valuetext", text);
  setText(field.closest(".control")?.querySelector(".control-value"), text);
}

/** `f/2.8`, `5.0 m`, `30°`, with a true minus sign. */
export function formatValue(
  slider: { decimals?: number; prefix?: string; unit?: string },
  value: number,
) {
  const number = value.toFixed(slider.decimals ?? 0);
  const signed = Number(number) === 0 ? number.replace("-", "") : number.replace("-", "\u2212");
  return withUnit(`${slider.prefix ?? ""}${numeral(signed)}`, slider.unit ?? "");
}
