/** Words and numbers in the page. */

/** Write only what differs: an unchanged text is not laid out, selected or read out anew. */
export function setText(/** @type {Element | null | undefined} */ element, /** @type {string} */ text) {
  if (element && element.textContent !== text) element.textContent = text;
}

/** `16.0 px`, on one line; degrees stand close: as `with_unit` of site_builder/quantities.py. */
export function withUnit(/** @type {string} */ text, /** @type {string} */ unit) {
  return text + (unit === "" || unit === "°" ? "" : "\u00a0") + unit;
}
