/** Pauses for work that nobody waits for. */

/** Longest wait for a pause on a page that has none, in milliseconds. */
const LONGEST = 200;

/** Until what changed just now is on the screen; in a window that is not shown, until it is. */
export function painted() {
  return new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
}

/** Until the browser has nothing else to do for the page. */
export function idle() {
  if (!globalThis.requestIdleCallback) return painted();
  return new Promise((resolve) => requestIdleCallback(resolve, { timeout: LONGEST }));
}
