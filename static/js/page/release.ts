/** A new release of the book, as an open page notices it. */

import { showNotice } from "./notice.ts";
import { words } from "./words.ts";

/** Messages of browsers for a script that is imported late and does not arrive. */
const MISSING = /dynamically imported module|[Ii]mporting a module script/;

/** Whether a script that was requested late did not arrive, or is none. */
function isMissingScript(reason: unknown) {
  return reason instanceof SyntaxError || (reason instanceof Error && MISSING.test(reason.message));
}

/**
 * Of the page that was loaded; those that were turned to are of the same release. (On the way back to
 * a page the address is that one's before its text has come.)
 */
const CURRENT = releaseFolders(document, location.href);

/** Offer a reload where a late import fails, as its release or host may be gone. Called once. */
export function install() {
  addEventListener("unhandledrejection", async (event) => {
    if (!isMissingScript(event.reason)) return;
    event.preventDefault();
    if (!(await offerRelease())) offerReload("page.missing");
  });
}

/** Offer to load the page anew where the host has another release; whether it has. */
export async function offerRelease(): Promise<boolean> {
  try {
    const reply = await fetch(location.href, { cache: "no-cache" });
    const page = new DOMParser().parseFromString(await reply.text(), "text/html");
    if (!page.body.dataset.assets || isOfRelease(page)) return false;
  } catch {
    return false;
  }
  offerReload("page.renewed");
  return true;
}

/** Some browsers request a script that did not arrive only once in a page. */
function offerReload(key: string) {
  showNotice(words(key), { label: words("page.reload"), act: () => location.reload() });
}

/**
 * Whether a page loads what this one does: scripts, and the Python that runs as long as pages are
 * turned.
 *
 * @param address The page's own.
 */
export function isOfRelease(page: Document, address: string = location.href) {
  return releaseFolders(page, address) === CURRENT;
}

function releaseFolders({ body: { dataset } }: Document, address: string) {
  const all = [dataset.assets, dataset.runtime];
  return all.map((folder) => folder && new URL(folder, address).href).join();
}
