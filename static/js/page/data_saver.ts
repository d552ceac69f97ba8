/**
 * Readers who pay for what is fetched, or wait long for it, or whose device has little memory, as the
 * page's head found: for them Python waits to be asked for, once in a visit.
 */

import { STORAGE } from "../book.js";

const { dataset } = document.documentElement;

/** Whether the reader pays for what is fetched, or waits long for it. */
export function isMetered() {
  return "metered" in dataset;
}

/** Whether Python must not start before the reader asks. */
export function isSparing() {
  return "saving" in dataset;
}

/** The reader has asked: until the visit ends, pages start Python as for others. */
export function stopSparing() {
  delete dataset.saving;
  try {
    sessionStorage.setItem(`${STORAGE}asked`, "yes");
  } catch {
    // The next page asks again.
  }
}
