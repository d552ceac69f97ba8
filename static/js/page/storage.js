/** Small things worth remembering. Where the browser forbids storage, nothing is remembered. */

const PREFIX = "image-formation:";

/**
 * What was kept under `key`, or null.
 *
 * @param {string} key
 * @returns {any}
 */
export function recall(key) {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + key) ?? "null");
  } catch {
    return null;
  }
}

/**
 * Keep `value` under `key`; null forgets.
 *
 * @param {string} key
 * @param {unknown} value
 */
export function remember(key, value) {
  try {
    if (value === null) localStorage.removeItem(PREFIX + key);
    else localStorage.setItem(PREFIX + key, JSON.stringify(value));
  } catch {
    // Blocked or full: the page works the same, only without memory.
  }
}
