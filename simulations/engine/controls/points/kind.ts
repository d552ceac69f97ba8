/** Lists of points in a picture: a hidden `input[type=text]`, which handles write. */

import type { Control, Kind } from "../../../../static/js/figure/controls.ts";

export interface Points extends Control {
  kind: "points";
  default: string;
  lists: number;
  /** Most points of a list. */
  most: number;
}

/** As Python writes them: `corner_3;0.1,0.2_0.5,0.6;;`. */
const HEAD = /^[a-z]*(_\d{1,3})?$/;
const POINT = /^(0(\.\d+)?|1),(0(\.\d+)?|1)$/;

export const kind: Kind<Points, HTMLInputElement> = {
  read: (field, control) => (isLegal(field.value, control) ? field.value : control.default),

  write(field, _control, value) {
    field.value = String(value);
  },

  parse: (control, text) => (isLegal(text, control) ? text : undefined),
};

function isLegal(text: string, { lists, most }: Points) {
  const [head, ...rest] = text.split(";");
  const all = rest.map((list) => (list ? list.split("_") : []));
  const few = all.length <= lists && all.every((list) => list.length <= most);
  return few && HEAD.test(head) && all.flat().every((point) => POINT.test(point));
}

export function isPoints(control: Control | undefined): control is Points {
  return control?.kind === "points";
}
