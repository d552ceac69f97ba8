/** The line under a figure that tells what went wrong. */

import { one } from "../page/dom.js";

/**
 * Show `message` under the figure, or nothing.
 *
 * @param {HTMLElement} figure
 * @param {string} message
 * @param {boolean} [retry] Whether to offer another try.
 */
export function say(figure, message, retry = false) {
  one(figure, ".figure-message", HTMLElement).textContent = message;
  one(figure, ".figure-status", HTMLElement).hidden = !message;
  one(figure, ".retry", HTMLButtonElement).hidden = !retry;
}
