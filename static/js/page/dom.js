/** Elements that must be there, with the type that they must have. */

/**
 * The first descendant of `root` that fits.
 *
 * @template {Element} T
 * @param {ParentNode} root
 * @param {string} selector
 * @param {new () => T} type
 * @returns {T}
 * @throws {Error} Where there is none, or it is of another type.
 */
export function one(root, selector, type) {
  const found = maybe(root, selector, type);
  if (!found) throw new Error(`the page has no ${selector}`);
  return found;
}

/**
 * The first descendant of `root` that fits, or null.
 *
 * @template {Element} T
 * @param {ParentNode} root
 * @param {string} selector
 * @param {new () => T} type
 * @returns {T | null}
 * @throws {Error} Where it is of another type.
 */
export function maybe(root, selector, type) {
  const found = root.querySelector(selector);
  if (!found) return null;
  if (!(found instanceof type)) throw new Error(`${selector} is no ${type.name}`);
  return found;
}

/**
 * All descendants of `root` that fit and are of the type.
 *
 * @template {Element} T
 * @param {ParentNode} root
 * @param {string} selector
 * @param {new () => T} type
 * @returns {T[]}
 */
export function all(root, selector, type) {
  const found = [...root.querySelectorAll(selector)];
  return found.flatMap((element) => (element instanceof type ? [element] : []));
}

/**
 * The element in which an event happened that fits, or null.
 *
 * @template {Element} T
 * @param {Event} event
 * @param {string} selector
 * @param {new () => T} type
 * @returns {T | null}
 */
export function within(event, selector, type) {
  const found = event.target instanceof Element ? event.target.closest(selector) : null;
  return found instanceof type ? found : null;
}

/**
 * Whether a click on a link asks for no more than to follow it: not for a new window, say.
 *
 * @param {MouseEvent} event
 */
export function isPlain(event) {
  const { button, metaKey, ctrlKey, shiftKey, altKey } = event;
  return button === 0 && !(metaKey || ctrlKey || shiftKey || altKey);
}

/**
 * What a `<script type="application/json">` of the page says.
 *
 * @param {ParentNode} root
 * @param {string} selector
 * @returns {any}
 */
export function data(root, selector) {
  return JSON.parse(one(root, selector, HTMLScriptElement).text);
}
