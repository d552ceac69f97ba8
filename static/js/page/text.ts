/** Words and numbers in the page. */

/** Write only what differs: an unchanged text is not laid out, selected or read out anew. */
export function setText(element: Element | null | undefined, text: string) {
  if (element && element.textContent !== text) element.textContent = text;
}

/** As `setText`, of an attribute. */
export function setAttribute(element: Element, name: string, value: string) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/** `16.0 px`, on one line; degrees stand close: as `with_unit` of the builder's quantities.py. */
export function withUnit(text: string, unit: string) {
  return text + (unit === "" || unit === "°" ? "" : "\u00a0") + unit;
}
