/**
 * Small things worth remembering. What the browser will not keep, denied or full as its storage may
 * be, is remembered until the page is left for good, and the page is told of it once.
 */

import { STORAGE } from "../book.js";

/** What could not be kept. @type {Map<string, unknown>} */
const passing = new Map();

/** Dispatched on `window` at the first thing that could not be kept. */
export const FORGETFUL = "forgetful";

/**
 * What was kept under `key`, or null.
 *
 * @param {string} key
 * @returns {any}
 */
export function recall(key) {
  if (passing.has(key)) return passing.get(key);
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
    passing.delete(key);
  } catch {
    const isFirst = passing.size === 0;
    passing.set(key, value);
    if (isFirst) dispatchEvent(new Event(FORGETFUL));
  }
}

/**
 * Hear of what another tab kept or forgot.
 *
 * @param {(key: string | null) => void} changed Called with its key; null where all was forgotten.
 */
export function onOtherTab(changed) {
  addEventListener("storage", ({ key, storageArea }) => {
    if (key !== null && !key.startsWith(STORAGE)) return;
    if (storageArea === sessionStorage) return;
    const own = key && key.slice(STORAGE.length);
    if (own) passing.delete(own); // theirs came later
    changed(own);
  });
}

/**
 * All that was kept under names that fit.
 *
 * @param {RegExp} names
 * @returns {Record<string, unknown>}
 */
export function kept(names) {
  const fitting = new Set([...keptKeys(), ...passing.keys()].filter((key) => names.test(key)));
  const all = [...fitting].map((key) => [key, recall(key)]);
  return Object.fromEntries(all.filter(([, value]) => value !== null));
}

/** Names of what the browser keeps for the book. */
function keptKeys() {
  try {
    const keys = Object.keys(localStorage).filter((key) => key.startsWith(STORAGE));
    return keys.map((key) => key.slice(STORAGE.length));
  } catch {
    return [];
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
