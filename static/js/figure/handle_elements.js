/**
 * Handles as elements of the page: what they drive, where they are, and which one a press means.
 *
 * @typedef {[number, number]} Point In view box units of a panel.
 */

import { all, maybe, one, within } from "../page/dom.js";

/** Handles that are nearer to the pointer than this, in CSS pixels, compete for it. */
const REACH = 22;

/**
 * The handle that a press means: the nearest mark within reach, else what lies under it.
 *
 * @param {HTMLElement} layer
 * @param {PointerEvent} event
 * @returns {HTMLElement | null}
 */
export function grabbed(layer, event) {
  const near = all(layer, "[data-handle]:not(.drag, .aim, [hidden])", HTMLElement)
    .map((element) => ({ element, distance: distanceTo(element, event) }))
    .filter(({ distance }) => distance <= REACH)
    .sort((a, b) => a.distance - b.distance);
  if (near.length > 0) return near[0].element;
  const ground = within(event, ".handle-ground", HTMLElement)?.dataset.groundOf;
  const target = ground
    ? maybe(layer, `[data-handle="${CSS.escape(ground)}"]`, HTMLElement)
    : within(event, "[data-handle]", HTMLElement);
  return target && !target.hidden ? target : null;
}

/** @param {HTMLElement} element */
export function name(element) {
  return element.dataset.handle ?? "";
}

/** @param {HTMLElement} element */
export function driven(element) {
  return (element.dataset.drives ?? "").split(" ");
}

/** @param {HTMLElement} element */
export function reversed(element) {
  return (element.dataset.reversed ?? "").split(" ");
}

/**
 * The view box of the panel that a handle lies in.
 *
 * @param {HTMLElement} element
 */
function viewBox(element) {
  const view = element.closest(".panel-view") ?? element;
  return one(view, "svg.overlay", SVGSVGElement).viewBox.baseVal;
}

/**
 * Where a pointer is, in view box units of the handle's panel.
 *
 * @param {HTMLElement} element
 * @param {PointerEvent} event
 * @returns {Point}
 */
export function inPanel(element, event) {
  const { width, height } = viewBox(element);
  const box = (element.closest(".handles") ?? element).getBoundingClientRect();
  return [
    ((event.clientX - box.left) / box.width) * width,
    ((event.clientY - box.top) / box.height) * height,
  ];
}

/**
 * Where a handle is, in view box units of its panel.
 *
 * @param {HTMLElement} element
 * @returns {Point}
 */
export function center(element) {
  const { width, height } = viewBox(element);
  return [
    (Number.parseFloat(element.style.getPropertyValue("--x")) / 100) * width,
    (Number.parseFloat(element.style.getPropertyValue("--y")) / 100) * height,
  ];
}

/**
 * Move a handle to a place of its panel.
 *
 * @param {HTMLElement} element
 * @param {{x: number, y: number}} place
 */
export function put(element, place) {
  const { width, height } = viewBox(element);
  setProperty(element, "--x", `${((100 * place.x) / width).toFixed(3)}%`);
  setProperty(element, "--y", `${((100 * place.y) / height).toFixed(3)}%`);
}

/**
 * @param {HTMLElement} element
 * @param {string} property
 * @param {string} value
 */
function setProperty({ style }, property, value) {
  if (style.getPropertyValue(property) !== value) style.setProperty(property, value);
}

/**
 * CSS pixels from a handle's mark to the pointer.
 *
 * @param {HTMLElement} element
 * @param {PointerEvent} event
 */
function distanceTo(element, event) {
  const box = element.getBoundingClientRect();
  const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
  return Math.hypot(event.clientX - x, event.clientY - y);
}
