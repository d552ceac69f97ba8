/** Small things worth remembering. Where the browser forbids storage, nothing is remembered. */

const PREFIX = "image-formation:";

/** @param {string} key @returns {any} What was kept, or null. */
export function recall(key) {
  try {
    return JSON.parse(localStorage.getItem(PREFIX + key) ?? "null");
  } catch {
    return null;
  }
}

/** @param {string} key @param {any} value Null forgets. */
export function remember(key, value) {
  try {
    if (value === null) localStorage.removeItem(PREFIX + key);
    else localStorage.setItem(PREFIX + key, JSON.stringify(value));
  } catch {
    // Blocked or full: the page works the same, only without memory.
  }
}
