/** What can be pushed sideways can be focused, so that arrow keys push it, too. */

const BOXES = ".panels, .formula, .table-wrapper, .nowrap, :is(p, li) > math, pre";

const sizes = new ResizeObserver((entries) => {
  for (const { target } of entries) mark(target);
});

/** Look after the boxes of the page that is shown. */
export function watchScrollers() {
  sizes.disconnect();
  for (const box of document.querySelectorAll(BOXES)) sizes.observe(box);
  // A font that comes late makes the contents wider, and not the box.
  document.fonts.ready.then(() => document.querySelectorAll(BOXES).forEach(mark));
}

/** @param {Element} box */
function mark(box) {
  const scrolls = getComputedStyle(box).overflowX !== "visible";
  if (scrolls && box.scrollWidth > box.clientWidth + 1) box.setAttribute("tabindex", "0");
  else box.removeAttribute("tabindex");
}
