/**
 * The memory of an interpreter that has started, kept for the next visit: there Python begins with
 * all that had been imported. It is kept with the runtime's address, so of another release none is
 * found; who cannot go on from it forgets it, and starts plainly.
 */

/** Another one where what is kept, or the order in which libraries are loaded, has changed. */
const FORMAT = "memory-1";
export const NO_BYTES = new Uint8Array();

/**
 * What is told of a memory.
 *
 * @typedef {object} About
 * @property {string[]} scenes Which are imported.
 * @property {number} importMs What importing the simulations took.
 */

/**
 * @typedef {object} Memory
 * @property {(module: any) => Promise<Partial<About> & {scenes: string[]}>} goOn Have an interpreter that is being made go on with
 *   it instead of starting: Emscripten's, with `_loadSnapshot: NO_BYTES`. Rejects where it is not as
 *   it was.
 */

/**
 * Keep a memory in place of any other of this book.
 *
 * @param {string} url The runtime's folder.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {About} about
 * @throws {Error} Where the browser keeps nothing, or not so much.
 */
export async function keepMemory(url, bytes, about) {
  const told = JSON.stringify({ ...about, hash: await hashOf(bytes) });
  await caches.delete(cacheOf(url));
  const cache = await caches.open(cacheOf(url));
  await cache.put(url + FORMAT, new Response(bytes, { headers: { about: told } }));
}

/**
 * What is kept for a runtime, if there is any.
 *
 * @param {string} url
 * @returns {Promise<Memory | null>}
 */
export async function recallMemory(url) {
  try {
    const kept = await caches.match(url + FORMAT, { cacheName: cacheOf(url) });
    if (!kept) return null;
    const { hash, ...about } = JSON.parse(kept.headers.get("about") ?? "");
    const bytes = readWhole(kept, hash);
    bytes.catch(() => {}); // told to who waits for them
    return {
      async goOn(module) {
        goOnWith(module, await bytes);
        return about;
      },
    };
  } catch {
    return null;
  }
}

/**
 * @param {Response} kept
 * @param {string} hash
 */
async function readWhole(kept, hash) {
  const bytes = new Uint8Array(await kept.arrayBuffer());
  if ((await hashOf(bytes)) !== hash) throw new Error("the memory is damaged");
  return bytes;
}

/** @param {string} url */
export async function hasMemory(url) {
  return (await caches.match(url + FORMAT, { cacheName: cacheOf(url) })) !== undefined;
}

/** @param {string} url */
export async function forgetMemory(url) {
  await globalThis.caches?.delete(cacheOf(url)).catch(() => {});
}

/**
 * Have an interpreter that is being made go on with a memory instead of starting.
 *
 * Pyodide asks for the bytes before it makes the interpreter; so that one can come beside the other,
 * it is given none, and here they take their place.
 *
 * @param {any} module Emscripten's, of an interpreter with `_loadSnapshot: NO_BYTES`.
 * @param {Uint8Array} bytes
 */
export function goOnWith(module, bytes) {
  if (module.HEAP8.length < bytes.length) module.growMemory(bytes.length);
  const restore = module.API.restoreSnapshot;
  module.API.restoreSnapshot = () => {
    module.API.restoreSnapshot = restore; // which holds no bytes
    return restore(bytes);
  };
}

/**
 * The cache's name; the service worker knows it, too.
 *
 * @param {string} url Of a runtime's folder, two below the book's root.
 */
function cacheOf(url) {
  return `${new URL("../../", url).href}#memory`;
}

/** @param {Uint8Array<ArrayBuffer>} bytes */
async function hashOf(bytes) {
  const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  return Array.from(hash, (byte) => byte.toString(16).padStart(2, "0")).join("");
}
