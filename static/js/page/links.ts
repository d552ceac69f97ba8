/** Links from one page of the book to another. */

/** Where a link leads, if that is another page of the book, or another state of its figures. */
export function linkedPage(link: HTMLAnchorElement): URL | null {
  const { root } = document.body.dataset;
  if (root === undefined || link.target || link.hasAttribute("download")) return null;
  const url = new URL(link.href);
  const book = new URL(root || "./", location.href).href;
  const inBook = url.href.startsWith(book) && /(\/|\.html)$/.test(url.pathname);
  const isOther = url.pathname + url.search !== location.pathname + location.search;
  return inBook && isOther ? url : null;
}
