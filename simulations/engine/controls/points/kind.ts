/** Lists of points in a picture: a hidden `input[type=text]`, which handles write. */

import type { Control, Kind } from "../../../../static/js/figure/control.ts";

export interface Points extends Control {
  kind: "points";
  default: string;
}

/** As Python writes them: `corner_3;0.1,0.2_0.5,0.6;;`. */
const TEXT = /^[a-z]*(_\d+)?(;([01](\.\d+)?,[01](\.\d+)?(_|(?=;|$)))*)*$/;

export const kind: Kind<Points, HTMLInputElement> = {
  read: (field, control) => (TEXT.test(field.value) ? field.value : control.default),

  write(field, _control, value) {
    field.value = String(value);
  },

  parse: (_control, text) => (TEXT.test(text) ? text : undefined),
};

export function isPoints(control: Control | undefined): control is Points {
  return control?.kind === "points";
}
