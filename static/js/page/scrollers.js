/** What can be pushed sideways can be focused, so that arrow keys push it, too. */

const BOXES = ".panels, .equation, .table-wrapper, .nowrap, pre";

const sizes = new ResizeObserver((entries) => {
  for (const { target } of entries) if (target instanceof HTMLElement) mark(target);
});

/** Look after the boxes of the page that is shown. */
export function watchScrollers() {
  sizes.disconnect();
  for (const box of document.querySelectorAll(BOXES)) sizes.observe(box);
}

/** @param {HTMLElement} box */
function mark(box) {
  if (box.scrollWidth > box.clientWidth + 1) box.tabIndex = 0;
  else box.removeAttribute("tabindex");
}
