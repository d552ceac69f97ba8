/**
 * Readers who pay for what is fetched, or wait long for it, or whose device has little memory, as the
 * page's head found: for them Python waits to be asked for, once in a visit. So it does where the tab
 * crashed twice in a row while Python started, each time.
 */

import { STORAGE } from "../book.js";
import { words } from "./words.ts";

const { dataset } = document.documentElement;

/** Whether the reader pays for what is fetched, or waits long for it. */
export function isMetered() {
  return "metered" in dataset;
}

/** Whether the reader has asked for little to be fetched. */
export function savesData() {
  return dataset.metered === "saves";
}

/** Whether Python must not start before the reader asks. */
export function isStartDeferred() {
  return "saving" in dataset;
}

/** Why Python waits, in words. */
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

/** The reader has asked: until the visit ends, pages start Python as for others. */
export function allowStart() {
  delete dataset.saving;
  try {
    sessionStorage.setItem(`${STORAGE}asked`, "yes");
  } catch {
    // The next page asks again.
  }
}
