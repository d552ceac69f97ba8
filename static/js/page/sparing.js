/**
 * Readers whose link or device is to be spared, as the page's head found: those who pay for what is
 * fetched or wait long for it, or whose device has little memory. For them Python waits to be asked
 * for, once in a visit.
 */

import { STORAGE } from "../book.js";

const { dataset } = document.documentElement;

/** Whether the reader pays for what is fetched, or waits long for it. */
export function isMetered() {
  return "metered" in dataset;
}

/** Whether Python is not to start before the reader asks. */
export function isSparing() {
  return "sparing" in dataset;
}

/** The reader has asked: until the visit ends, pages start Python as they do for others. */
export function spareNoMore() {
  delete dataset.sparing;
  try {
    sessionStorage.setItem(`${STORAGE}asked`, "yes");
  } catch {
    // The next page asks again.
  }
}
