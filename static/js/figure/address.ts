/** How the address of a page names the settings of a figure. */

/** Begins their names; nothing on a page of the figure's own. */
export function prefixOf(figure: HTMLElement) {
  return isEmbed() ? "" : `${figure.closest("figure")?.id}.`;
}

/** Whether the page is a figure's own, for a frame in another page. */
export function isEmbed() {
  return "embed" in document.body.dataset;
}

/** Whether the address sets some of the figure's controls. */
export function isAddressed(figure: HTMLElement) {
  const prefix = prefixOf(figure);
  return [...new URLSearchParams(location.search).keys()].some((key) => key.startsWith(prefix));
}
