/**
 * Has the memory of an interpreter kept for the next visit, once the book itself is kept on the
 * device and nothing goes on in the page: that takes another interpreter, for some seconds.
 */

import { serviceWorkers } from "../page/offline.js";
import { isMetered, isSparing } from "../page/sparing.js";
import { recall, remember } from "../page/storage.js";
import { hasMemory } from "./memory.js";
import { sharedRuntime } from "./runtime.js";

/** Under which name the browser keeps for which runtime this was tried, and how often. */
const TRIED = "memory";
/** Where it cannot be kept so often, it is not tried again. */
const MOST_TRIES = 3;
/** Milliseconds between two looks. */
const LOOK = 1000;
/** Gigabytes that a device has at least which can spare those of a second interpreter. */
const LEAST = 4;

/**
 * Called once.
 *
 * @param {() => boolean} isAtRest Whether nobody would mind.
 */
export async function readyNextVisit(isAtRest) {
  const { deviceMemory = LEAST } = /** @type {{deviceMemory?: number}} */ (navigator);
  if (document.body.dataset.offline === undefined || deviceMemory < LEAST || isMetered()) return;
  const workers = serviceWorkers();
  if (!workers) return;
  while (!workers.controller || isSparing() || !isAtRest()) {
    await new Promise((resolve) => setTimeout(resolve, LOOK));
  }
  const url = sharedRuntime()?.url;
  const tried = recall(TRIED);
  const tries = tried?.url === url ? tried.tries : 0;
  if (!url || tries === MOST_TRIES || (await hasMemory(url).catch(() => true))) return;
  remember(TRIED, { url, tries: tries + 1 });
  const keeper = new Worker(new URL("./keeper.js", import.meta.url), { type: "module" });
  keeper.onmessage = () => keeper.terminate();
  keeper.onerror = (event) => event.preventDefault();
  keeper.postMessage({ url, known: true, scenes: [], table: document.body.dataset.table });
}
