/** Small things worth remembering. Where the browser forbids storage, nothing is remembered. */

import { STORAGE } from "../book.js";

/**
 * What was kept under `key`, or null.
 *
 * @param {string} key
 * @returns {any}
 */
export function recall(key) {
  try {
    return JSON.parse(localStorage.getItem(STORAGE + key) ?? "null");
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
    if (value === null) localStorage.removeItem(STORAGE + key);
    else localStorage.setItem(STORAGE + key, JSON.stringify(value));
  } catch {
    // Blocked or full: the page works the same, only without memory.
  }
}

/**
 * All that was kept under names that fit.
 *
 * @param {RegExp} names
 * @returns {Record<string, unknown>}
 */
export function kept(names) {
  try {
    const keys = Object.keys(localStorage).filter((key) => key.startsWith(STORAGE));
    const fitting = keys.map((key) => key.slice(STORAGE.length)).filter((key) => names.test(key));
    return Object.fromEntries(fitting.map((key) => [key, recall(key)]));
  } catch {
    return {};
  }
}

/**
 * Forget what was kept under names that fit.
 *
 * @param {RegExp} names
 */
export function forget(names) {
  for (const key of Object.keys(kept(names))) remember(key, null);
}
