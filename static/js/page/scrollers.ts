/** What can be pushed sideways can be focused, so that arrow keys push it, too. */

const BOXES = ".other-panels, .formula, .table-wrapper, .nowrap, :is(p, li) > math, pre";

const sizes = new ResizeObserver((entries) => mark(entries.map(({ target }) => target)));

/** Look after the boxes of the page that is shown. */
export function watchScrollers() {
  sizes.disconnect();
  for (const box of document.querySelectorAll(BOXES)) sizes.observe(box);
  // A font that comes late makes the contents wider, and not the box. What is not shown, as it is
  // folded up, is not laid out for this: the observer tells of it once it is.
  document.fonts.ready.then(() => mark([...document.querySelectorAll(BOXES)].filter(isShown)));
}

function isShown(box: Element) {
  return box.checkVisibility?.({ contentVisibilityAuto: true }) ?? true;
}

/** All are looked at before one is changed, or the page would be laid out for each. */
function mark(boxes: Element[]) {
  const wrong = boxes.filter((box) => scrolls(box) !== box.hasAttribute("tabindex"));
  for (const box of wrong) {
    if (box.hasAttribute("tabindex")) box.removeAttribute("tabindex");
    else box.setAttribute("tabindex", "0");
  }
}

function scrolls(box: Element) {
  return box.scrollWidth > box.clientWidth + 1 && getComputedStyle(box).overflowX !== "visible";
}
