/** Orders drawn by chance for each reader, then the same on every visit. */

import { loadItem, saveItem } from "../page/storage.ts";

/** The seed of this reader's orders; where nothing is stored, it lasts as long as the page. */
let seed = "";

/** The numbers from 0 to `count` − 1 in the reader's order of the things called `name`. */
export function shuffled(name: string, count: number) {
  const hashes = Array.from({ length: count }, (_, index) =>
    hash(`${readerSeed()}${name} ${index}`),
  );
  return [...hashes.keys()].sort((one, other) => hashes[one] - hashes[other]);
}

/** The stored seed of this reader's orders. */
function readerSeed() {
  if (!seed) {
    const stored = loadItem("order");
    seed =
      typeof stored === "string" ? stored : crypto.getRandomValues(new Uint32Array(2)).join("-");
    saveItem("order", seed);
  }
  return seed;
}

/**
 * FNV-1a, which spreads short texts over 32 bits, with the last step of MurmurHash3, which mixes them.
 */
function hash(text: string) {
  let value = 0x811c9dc5;
  for (const letter of text) value = Math.imul(value ^ letter.charCodeAt(0), 0x01000193);
  value = Math.imul(value ^ (value >>> 16), 0x85ebca6b);
  value = Math.imul(value ^ (value >>> 13), 0xc2b2ae35);
  return (value ^ (value >>> 16)) >>> 0;
}
