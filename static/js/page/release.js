/** The turn from one release of the book to the next, as an open page meets it. */

import { notice } from "./notice.js";
import { words } from "./words.js";

/** Where the host has another release than this page came from, offer to load the page anew. */
export async function offerRelease() {
  const page = await newest().catch(() => null);
  if (!page?.body.dataset.assets || releaseOf(page.body) === releaseOf(document.body)) return;
  notice(words("page.renewed"), { label: words("page.reload"), act: () => location.reload() });
}

/** This page as the host has it now. */
async function newest() {
  const reply = await fetch(location.href, { cache: "no-cache" });
  return new DOMParser().parseFromString(await reply.text(), "text/html");
}

/** @param {HTMLElement} body */
function releaseOf({ dataset }) {
  return `${dataset.assets} ${dataset.runtime}`;
}
