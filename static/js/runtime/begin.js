/**
 * Begins the worker, and with it the downloads of the interpreter, while the page is still being
 * read. The head of a page with figures asks for this script before all others; it imports nothing,
 * so that it waits for nothing.
 */

/** @type {Worker | null} */
let begun = null;

/** The worker that the page's head has begun, for the first who asks; null where there is none. */
export function takeBegun() {
  const worker = begun;
  begun = null;
  return worker;
}

function begin() {
  const script = document.querySelector("script[data-begin]");
  if (!(script instanceof HTMLElement) || typeof WebAssembly !== "object") return;
  const { begin: address = "", scenes = "" } = script.dataset;
  begun = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  begun.onerror = (event) => {
    event.preventDefault();
    begun = null; // who needs one begins another, and tells what goes wrong
  };
  const url = new URL(address, location.href).href;
  begun.postMessage({ id: 0, call: "begin", url, scenes: scenes.split(" ") });
}

begin();
