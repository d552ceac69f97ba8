/**
 * Small things worth remembering. What the browser does not store, denied or full as its storage may
 * be, is remembered until the page is left for good, and the reader is told of it once.
 */

import { STORAGE } from "../book.js";

/** What could not be stored. */
const passing: Map<string, unknown> = new Map();

/** What a reader would miss. */
const DEAR = /^(quiz|predict|python):/;
let isReported = false;

/** Dispatched on `window` when something dear could not be stored, once. */
export const FORGETFUL = "forgetful";

/** What was remembered under `key`, or null. */
export function recall(key: string): any {
  if (passing.has(key)) return passing.get(key);
  try {
    return JSON.parse(localStorage.getItem(STORAGE + key) ?? "null");
  } catch {
    return null;
  }
}

/** Remember `value` under `key`; null forgets. */
export function remember(key: string, value: unknown) {
  try {
    if (value === null) localStorage.removeItem(STORAGE + key);
    else localStorage.setItem(STORAGE + key, JSON.stringify(value));
    passing.delete(key);
  } catch {
    passing.set(key, value);
    if (isReported || value === null || !DEAR.test(key)) return;
    isReported = true;
    dispatchEvent(new Event(FORGETFUL));
  }
}

/**
 * Follow what another tab remembers or forgets.
 *
 * @param changed Called with its key; null where all was forgotten.
 */
export function onOtherTab(changed: (key: string | null) => void) {
  addEventListener("storage", ({ key, storageArea }) => {
    if ((key !== null && !key.startsWith(STORAGE)) || storageArea === sessionStorage) return;
    const own = key?.slice(STORAGE.length) ?? null;
    if (own) passing.delete(own); // theirs came later
    changed(own);
  });
}

/** All that was remembered under names that fit. */
export function stored(names: RegExp): Record<string, unknown> {
  let stored: string[] = [];
  try {
    stored = Object.keys(localStorage).filter((key) => key.startsWith(STORAGE));
  } catch {
    // Denied: there is only what passes.
  }
  const keys = new Set([...stored.map((key) => key.slice(STORAGE.length)), ...passing.keys()]);
  const fitting = [...keys].filter((key) => names.test(key)).map((key) => [key, recall(key)]);
  return Object.fromEntries(fitting.filter(([, value]) => value !== null));
}

/** Forget what was remembered under names that fit. */
export function forget(names: RegExp) {
  for (const key of Object.keys(stored(names))) remember(key, null);
}
