/** The list of chapters behind its button, where the window has no room beside the text. */

import { maybe, within } from "./dom.ts";

/** Listen for the contents button on any page. */
export function installContents() {
  document.addEventListener("click", (event) => {
    const pressed = within(event, ".contents-toggle", Element);
    if (pressed || !within(event, "#contents", Element)) setOpen(!!pressed && !isOpen());
  });
  document.addEventListener("keydown", ({ key }) => {
    if (key !== "Escape" || !isOpen()) return;
    setOpen(false);
    toggle()?.focus();
  });
}

function toggle() {
  return maybe(document, ".contents-toggle", HTMLButtonElement);
}

function isOpen() {
  return toggle()?.ariaExpanded === "true";
}

function setOpen(open: boolean) {
  toggle()?.setAttribute("aria-expanded", String(open));
  document.getElementById("contents")?.classList.toggle("open", open);
}
