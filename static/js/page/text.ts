/** Words and numbers in the page. */

import { numeral } from "./words.ts";

/** Write only what differs: an unchanged text is not laid out, selected or read out anew. */
export function setText(element: Element | null | undefined, text: string) {
  if (element && element.textContent !== text) element.textContent = text;
}

/** Set an attribute, as `setText` sets a text. */
export function setAttribute(element: Element, name: string, value: string) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/** `16.0 px`, on one line; degrees stand close: as `with_unit` of `site_builder/benchmarks/judgements.py`. */
export function withUnit(text: string, unit: string) {
  return text + (unit === "" || unit === "°" ? "" : "\u00a0") + unit;
}

/** The value of a slider: `f/2.8`, `5.0 m`, `30°`, with a true minus sign. */
export function formatValue(
  slider: { decimals?: number; prefix?: string; unit?: string },
  value: number,
) {
  const number = value.toFixed(slider.decimals ?? 0);
  const signed = Number(number) === 0 ? number.replace("-", "") : number.replace("-", "\u2212");
  return withUnit(`${slider.prefix ?? ""}${numeral(signed)}`, slider.unit ?? "");
}
