/** An order that is the reader's own: by chance once, then the same on every visit. */

import { recall, remember } from "../page/storage.js";

/** What this reader's orders come from; where nothing is remembered, as long as the page lasts. */
let seed = "";

/**
 * The numbers from 0 to `count` − 1 in the reader's order.
 *
 * @param {string} name What is to be put in order.
 * @param {number} count
 */
export function shuffled(name, count) {
  const chance = numbers(hash(readerSeed() + name));
  const order = Array.from({ length: count }, (_, index) => index);
  for (let last = count - 1; last > 0; last -= 1) {
    const other = Math.floor(chance() * (last + 1));
    [order[last], order[other]] = [order[other], order[last]];
  }
  return order;
}

function readerSeed() {
  if (!seed) {
    const kept = recall("order");
    seed = typeof kept === "string" ? kept : crypto.getRandomValues(new Uint32Array(2)).join("-");
    remember("order", seed);
  }
  return seed;
}

/**
 * FNV-1a, which spreads short texts over 32 bits.
 *
 * @param {string} text
 */
function hash(text) {
  let value = 0x811c9dc5;
  for (const letter of text) value = Math.imul(value ^ letter.charCodeAt(0), 0x01000193);
  return value >>> 0;
}

/**
 * Numbers from 0 up to 1, as mulberry32 makes them.
 *
 * @param {number} state
 */
function numbers(state) {
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
}
