/** The turn from one release of the book to the next, as an open page meets it. */

import { notice } from "./notice.js";
import { words } from "./words.js";

/** What browsers say of a script that is asked for late and cannot be had. */
const MISSING = /dynamically imported module|[Ii]mporting a module script/;

/** Whatever a press asks for may have gone with its release, or its host: called once. */
export function watchScripts() {
  addEventListener("unhandledrejection", (event) => {
    if (!MISSING.test(event.reason?.message)) return;
    event.preventDefault();
    tellMissing();
  });
}

async function tellMissing() {
  if (!(await offerRelease())) notice(words("page.missing"));
}

/**
 * Where the host has another release than this page came from, offer to load the page anew.
 *
 * @returns {Promise<boolean>} Whether it has.
 */
export async function offerRelease() {
  const page = await newest().catch(() => null);
  if (!page?.body.dataset.assets || releaseOf(page.body) === releaseOf(document.body)) return false;
  notice(words("page.renewed"), { label: words("page.reload"), act: () => location.reload() });
  return true;
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
