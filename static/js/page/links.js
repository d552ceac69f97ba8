/** Links from one page of the book to another. */

/**
 * Where a link leads, if that is another page of the book; else null.
 *
 * @param {HTMLAnchorElement} link
 * @returns {URL | null}
 */
export function linkedPage(link) {
  if (link.target || link.hasAttribute("download")) return null;
  const url = new URL(link.href);
  const root = siteRoot(document.body, location.href);
  const inBook = root && url.href.startsWith(root) && /(\/|\.html)$/.test(url.pathname);
  return inBook && addressOf(url) !== addressOf(location) ? url : null;
}

/**
 * Of a page, with the state of its figures.
 *
 * @param {URL | Location} url
 */
function addressOf({ pathname, search }) {
  return pathname + search;
}

/**
 * The address of the book that a page belongs to.
 *
 * @param {HTMLElement} body
 * @param {string} base
 * @returns {string | null}
 */
function siteRoot(body, base) {
  const root = body.dataset.root;
  return root === undefined ? null : new URL(root || "./", base).href;
}
