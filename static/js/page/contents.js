/** The list of chapters behind its button, where the window has no room beside the text. */

/** Listen for the contents button on any page. */
export function installContents() {
  document.addEventListener("click", (event) => {
    const button = document.querySelector(".contents-toggle");
    if (!button) return;
    if (event.target.closest?.(".contents-toggle")) setOpen(button, !isOpen(button));
    else if (isOpen(button) && !event.target.closest?.("#contents")) setOpen(button, false);
  });
  document.addEventListener("keydown", (event) => {
    const button = document.querySelector(".contents-toggle");
    if (event.key !== "Escape" || !button || !isOpen(button)) return;
    setOpen(button, false);
    button.focus();
  });
}

/** @param {Element} button */
function isOpen(button) {
  return button.getAttribute("aria-expanded") === "true";
}

/** @param {Element} button @param {boolean} open */
function setOpen(button, open) {
  button.setAttribute("aria-expanded", String(open));
  document.getElementById("contents")?.classList.toggle("open", open);
}
