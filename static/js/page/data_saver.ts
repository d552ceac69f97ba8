/**
 * Readers who pay for what is fetched, or wait long for it, or whose device has little memory, as the
 * page's head found: for them Python starts at their request, once in a visit. So it does where the tab
 * crashed twice in a row while Python started, each time.
 */

import { STORAGE } from "../book.js";
import { words } from "./words.ts";

const { dataset } = document.documentElement;

/** Whether the reader pays for what is fetched, or waits long for it. */
export function isMetered() {
  return "metered" in dataset;
}

/** Whether the browser requests reduced data usage. */
export function savesData() {
  return dataset.metered === "saves";
}

/** Whether Python starts only at the reader's request. */
export function isStartDeferred() {
  return "saving" in dataset;
}

/** The text of why Python waits. */
export function deferralReason() {
  return words(dataset.saving === "crashed" ? "figure.crashed" : "figure.data_saver");
}

/** Python runs, and the tab with it. */
export function clearStartCount() {
  try {
    sessionStorage.removeItem(`${STORAGE}starts`);
  } catch {
    // Nothing was counted.
  }
}

/** Start Python on all pages until the visit ends. */
export function allowStart() {
  delete dataset.saving;
  try {
    sessionStorage.setItem(`${STORAGE}asked`, "yes");
  } catch {
    // The next page asks again.
  }
}
