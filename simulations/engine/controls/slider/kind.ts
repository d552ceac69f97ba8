/** A number in a closed range: `input[type=range]`. */

import type { Control, Kind } from "../../../../static/js/figure/controls.ts";
import { formatValue, setText } from "../../../../static/js/page/text.ts";

export interface Slider extends Control {
  kind: "slider";
  default: number;
  min: number;
  max: number;
  step: number;
  unit: string;
  prefix: string;
  decimals: number;
  /** Where it moves and comes back from, once, when its figure is first seen. */
  arrival?: number;
}

export const kind: Kind<Slider, HTMLInputElement> = {
  read: (field) => field.valueAsNumber,

  write(field, control, value) {
    field.value = String(value); // which the slider brings into its range and onto its steps
    showValue(field, control);
  },

  parse(_control, text) {
    const number = text.trim() === "" ? Number.NaN : Number(text);
    return Number.isFinite(number) ? number : undefined;
  },
};

export function isSlider(control: Control | undefined): control is Slider {
  return control?.kind === "slider";
}

/** Write the value beside a slider, and for screen readers. */
export function showValue(field: HTMLInputElement, slider: Slider) {
  const text = formatValue(slider, field.valueAsNumber);
  field.setAttribute("aria-valuetext", text);
  setText(field.closest(".control")?.querySelector(".control-value"), text);
}
