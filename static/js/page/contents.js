/** The list of chapters behind its button, where the window has no room beside the text. */

import { maybe, within } from "./dom.js";

/** Listen for the contents button on any page. */
export function installContents() {
  document.addEventListener("click", (event) => {
    const button = toggle();
    if (!button) return;
    if (within(event, ".contents-toggle", Element)) setOpen(button, !isOpen(button));
    else if (isOpen(button) && !within(event, "#contents", Element)) setOpen(button, false);
  });
  document.addEventListener("keydown", (event) => {
    const button = toggle();
    if (event.key !== "Escape" || !button || !isOpen(button)) return;
    setOpen(button, false);
    button.focus();
  });
}

function toggle() {
  return maybe(document, ".contents-toggle", HTMLButtonElement);
}

/** @param {HTMLButtonElement} button */
function isOpen(button) {
  return button.getAttribute("aria-expanded") === "true";
}

/**
 * @param {HTMLButtonElement} button
 * @param {boolean} open
 */
function setOpen(button, open) {
  button.setAttribute("aria-expanded", String(open));
  document.getElementById("contents")?.classList.toggle("open", open);
}
