/**
 * Keeps the whole book on the reader's device, a release at a time. The file `sw.js`, which the
 * builder writes, names the release and loads this one.
 *
 * A release is the list of its files in `offline.json`, each with the hash of what is in it, and
 * its name is the hash of that list. It is taken up when every file is there and is the right one,
 * so no page meets the assets of another release. What an earlier release holds already is copied.
 * Pages that were open before go on with the release that they came from.
 *
 * @typedef {Record<string, string>} Files Addresses below the book's root, and `sha256-` hashes.
 */

const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));

/** The release, as the `integrity` of its list; nothing where the book is not to be kept. */
const release = /** @type {{RELEASE: string}} */ (/** @type {unknown} */ (self)).RELEASE;
const root = worker.registration.scope;
const LIST = `${root}offline.json`;
const PREFIX = `${root} `;
const OWN = PREFIX + release;
/** What `runtime/memory.js` keeps: it goes with the book. */
const MEMORY = `${root}#memory`;
/** Files fetched at once: readers may be reading. */
const AT_ONCE = 4;
/** Milliseconds after which the page that was left for another is certainly gone. */
const TURN = 1000;

/** The assets that each open page came with, as it told. @type {Map<string, string>} */
const assetsOf = new Map();
/** @type {Promise<Files> | null} */
let list = null;

worker.addEventListener("install", (event) => {
  event.waitUntil((release ? takeUp() : Promise.resolve()).then(() => worker.skipWaiting()));
});
worker.addEventListener("activate", (event) => event.waitUntil(release ? tidy() : leave()));
worker.addEventListener("message", (event) => {
  const page = event.source;
  if (!release || !(page instanceof Client)) return;
  assetsOf.set(page.id, event.data.assets);
  event.waitUntil(pause(TURN).then(tidy));
});
worker.addEventListener("fetch", (event) => {
  const { method, url, cache } = event.request;
  if (cache === "only-if-cached") return; // the browser's own copy, with what it compiled of it
  if (release && method === "GET" && url.startsWith(root)) {
    event.respondWith(answer(event.request));
  }
});

/** Have every file of the release, or fail and leave all as it was. */
async function takeUp() {
  const reply = await fetch(LIST, { cache: "no-cache", integrity: release });
  const files = Object.entries(/** @type {Files} */ (await reply.clone().json()));
  const cache = await caches.open(OWN);
  const earlier = await earlierFiles();
  const take = async () => {
    for (let file = files.pop(); file; file = files.pop()) {
      const [address, hash] = file;
      const url = root + address;
      if (await cache.match(url)) continue; // from an attempt that was cut short
      await cache.put(url, (await earlier(hash)) ?? (await fetchExactly(url, hash)));
    }
  };
  try {
    await Promise.all(Array.from({ length: AT_ONCE }, take));
    await cache.put(LIST, reply); // last: a cache without it is not whole
  } catch (error) {
    if (error instanceof DOMException && error.name === "QuotaExceededError") {
      await caches.delete(OWN);
    }
    throw error;
  }
}

/**
 * Machine code as the browser has it, if it has: asked whether that is still new, a host would renew
 * it, and the browser forget what it compiled of it.
 *
 * @param {string} url
 * @param {string} hash
 */
async function fetchExactly(url, hash) {
  const ask = (/** @type {RequestCache} */ cache) => fetch(url, { cache, integrity: hash });
  const asIs = url.endsWith(".wasm") ? await ask("force-cache").catch(() => null) : null;
  const reply = asIs ?? (await ask("no-cache"));
  if (!reply.ok) throw new Error(`${url} cannot be had: ${reply.status}`);
  return reply.redirected ? new Response(reply.body, { headers: reply.headers }) : reply;
}

/**
 * Finds a file that is kept already, by what is in it.
 *
 * @returns {Promise<(hash: string) => Promise<Response | undefined>>}
 */
async function earlierFiles() {
  /** @type {Map<string, [Cache, string]>} */
  const found = new Map();
  for (const name of await releases()) {
    const cache = await caches.open(name);
    const files = await (await cache.match(LIST))?.json();
    for (const [address, hash] of Object.entries(files ?? {})) {
      found.set(hash, [cache, root + address]);
    }
  }
  return async (hash) => {
    const [cache, url] = found.get(hash) ?? [];
    return url === undefined ? undefined : cache?.match(url);
  };
}

/** Names of the caches that hold this book. */
async function releases() {
  return (await caches.keys()).filter((name) => name.startsWith(PREFIX));
}

/**
 * What the release has under the address; else what an earlier one has, for a page of that; else
 * what the network says.
 *
 * @param {Request} request
 */
async function answer(request) {
  const own = await caches.open(OWN);
  const url = fileOf(request.url);
  const kept = await own.match(url);
  if (kept) return asAsked(kept, request);
  if (await own.match(`${url}/`)) return Response.redirect(`${url}/`);
  for (const name of await releases()) {
    const left = await (await caches.open(name)).match(url);
    if (left) return asAsked(left, request);
  }
  return fetch(request);
}

/**
 * The whole file, or the part that a film or a download asks for (RFC 9110, section 14): browsers
 * take no whole file for a part.
 *
 * @param {Response} kept
 * @param {Request} request
 * @returns {Promise<Response>}
 */
async function asAsked(kept, { headers }) {
  const range = headers.get("range");
  const of = headers.get("if-range");
  const isOther = of && ![kept.headers.get("etag"), kept.headers.get("last-modified")].includes(of);
  if (!range || isOther) return kept;
  const file = await kept.clone().blob();
  const part = partOf(range, file.size);
  if (!part) return kept;
  const [start, end] = part;
  const where = start < end ? `${start}-${end - 1}` : "*";
  const told = new Headers({ "content-range": `bytes ${where}/${file.size}` });
  for (const name of ["content-type", "etag", "last-modified"]) {
    told.set(name, kept.headers.get(name) ?? "");
  }
  const asked = file.slice(start, Math.max(start, end));
  return new Response(asked, { status: start < end ? 206 : 416, headers: told });
}

/**
 * The first byte that is asked for and the one after the last; null where that means nothing, or
 * several parts at once.
 *
 * @param {string} range
 * @param {number} size
 * @returns {[number, number] | null}
 */
function partOf(range, size) {
  const asked = /^bytes=(\d*)-(\d*)$/.exec(range.trim());
  if (!asked || (!asked[1] && !asked[2])) return null;
  const [first, last] = [Number(asked[1]), Number(asked[2])];
  if (!asked[1]) return [Math.max(size - last, 0), size];
  if (!asked[2]) return [first, size];
  return last < first ? null : [first, Math.min(last + 1, size)];
}

/**
 * The address under which a file is kept: without the state of a figure or the name of a place.
 *
 * @param {string} address
 */
function fileOf(address) {
  const url = new URL(address);
  return url.origin + url.pathname.replace(/\/index\.html$/, "/");
}

/** Answer for all pages; drop earlier releases once no open page came from one. */
async function tidy() {
  await worker.clients.claim();
  const pages = await worker.clients.matchAll({ type: "window" });
  const files = await ownFiles();
  const isOurs = (/** @type {Client} */ page) =>
    Object.keys(files).some((name) => root + name === assetsOf.get(page.id));
  if (!pages.every(isOurs)) return;
  for (const name of await releases()) if (name !== OWN) await caches.delete(name);
}

/** @param {number} ms */
function pause(ms) {
  return new Promise((resolve) => setTimeout(resolve, ms));
}

/** @returns {Promise<Files>} */
function ownFiles() {
  list ??= caches
    .open(OWN)
    .then((cache) => cache.match(LIST))
    .then((reply) => reply?.json() ?? {});
  return list;
}

/** Give everything back, and have the pages come from the network again. */
async function leave() {
  for (const name of [...(await releases()), MEMORY]) await caches.delete(name);
  await worker.registration.unregister();
  const pages = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
  for (const page of pages) if (page.url.startsWith(root)) await page.navigate(page.url);
}
