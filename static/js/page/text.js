/** Words and numbers in the page. */

/**
 * Write only what differs: an unchanged text is not laid out, selected or read out anew.
 *
 * @param {Element | null | undefined} element
 * @param {string} text
 */
export function setText(element, text) {
  if (element && element.textContent !== text) element.textContent = text;
}

/**
 * As `setText`, of an attribute.
 *
 * @param {Element} element
 * @param {string} name
 * @param {string} value
 */
export function setAttribute(element, name, value) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/**
 * `16.0 px`, on one line; degrees stand close: as `with_unit` of the builder's quantities.py.
 *
 * @param {string} text
 * @param {string} unit
 */
export function withUnit(text, unit) {
  return text + (unit === "" || unit === "°" ? "" : "\u00a0") + unit;
}
