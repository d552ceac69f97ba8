/** One of several named options: `select`. */

import type { Control, Kind } from "../../../../static/js/figure/controls.ts";

export interface Choice extends Control {
  default: string;
  options: string[];
}

export const kind: Kind<Choice, HTMLSelectElement> = {
  read(field, control) {
    // A value that a script gave the menu and no reader could choose is put back.
    if (!control.options.includes(field.value)) field.value = control.default;
    return field.value;
  },

  write(field, _control, value) {
    field.value = String(value);
  },

  parse: ({ options }, text) => (options.includes(text) ? text : undefined),
};
