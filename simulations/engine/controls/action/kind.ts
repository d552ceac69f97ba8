/** A button; its value is the number of presses modulo the number of its labels. */

import type { Control, Kind } from "../../../../static/js/figure/controls.ts";

export interface Action extends Control {
  kind: "action";
  default: number;
  labels: string[];
  drives: string;
  effect: string;
  seconds: number;
  arrival: boolean;
}

export const kind: Kind<Action, HTMLButtonElement> = {
  read(field, { labels }) {
    const state = Number(field.dataset.state ?? 0);
    return labels[state] === undefined ? 0 : state;
  },

  write(field, { labels }, value) {
    field.dataset.state = String(value);
    field.textContent = labels[Number(value)];
  },

  parse({ labels }, text) {
    const state = text.trim() === "" ? Number.NaN : Number(text);
    return labels[state] === undefined ? undefined : state;
  },
};

export function isAction(control: Control | undefined): control is Action {
  return control?.kind === "action";
}
