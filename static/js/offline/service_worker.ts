/**
 * Stores the whole book on the reader's device, a release at a time. The file `sw.js`, which the
 * builder writes, names the release and loads this one.
 *
 * A release is the list of its files in `offline.json`, each with the hash of what is in it, and
 * its name is the hash of that list. It is used when every file is there and is the right one, so no
 * page meets the assets of another release. Pages that were open before go on with the release that
 * they came from.
 * Addresses below the book's root, and `sha256-` hashes.
 */
type Files = Record<string, string>;

const worker = self as unknown as ServiceWorkerGlobalScope;

/** The release, as the `integrity` of its list; empty where the book is not to be stored. */
const release = (self as unknown as { RELEASE: string }).RELEASE;
const root = worker.registration.scope;
const LIST = `${root}offline.json`;
const PREFIX = `${root} `;
const OWN = PREFIX + release;
/** Files fetched at once: readers may be reading. */
const AT_ONCE = 4;
/** Milliseconds after which the page that was left for another is certainly gone. */
const TURN = 1000;

/** The assets that each open page came with, as it said. */
const assetsOf: Map<string, string> = new Map();

worker.addEventListener("install", (event) => {
  const taking = release ? takeUp() : Promise.resolve();
  event.waitUntil(taking.then(() => worker.skipWaiting(), complain));
});
worker.addEventListener("activate", (event) => event.waitUntil(release ? tidy() : leave()));
worker.addEventListener("message", (event) => {
  const page = event.source;
  if (!release || !(page instanceof Client)) return;
  assetsOf.set(page.id, event.data.assets);
  event.waitUntil(new Promise((resolve) => setTimeout(resolve, TURN)).then(tidy));
});
worker.addEventListener("fetch", (event) => {
  const { method, url, cache } = event.request;
  if (cache === "only-if-cached") return; // the browser's own copy, with what it compiled of it
  if (release && method === "GET" && url.startsWith(root)) {
    event.respondWith(answer(event.request).catch(() => fetch(event.request)));
  }
});

/** Have every file of the release, or fail and leave all as it was. */
async function takeUp() {
  const reply = await fetch(LIST, { cache: "no-cache", integrity: release });
  const files = Object.entries((await reply.clone().json()) as Files);
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

/** Tell open pages why the book is not stored; throws that again. */
async function complain(error: Error) {
  const pages = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
  for (const page of pages) page.postMessage({ problem: error.message });
  throw error;
}

/**
 * Machine code as the browser has it, if it has: asked whether that is still new, a host would renew
 * it, and the browser forget what it compiled of it.
 */
async function fetchExactly(url: string, hash: string) {
  const ask = (cache: RequestCache) => fetch(url, { cache, integrity: hash });
  const asIs = url.endsWith(".wasm") ? await ask("force-cache").catch(() => null) : null;
  const reply = asIs ?? (await ask("no-cache"));
  if (!reply.ok) throw new Error(`${url} does not arrive: ${reply.status}`);
  return reply.redirected ? new Response(reply.body, { headers: reply.headers }) : reply;
}

/** Finds a file that is stored already, by what is in it. */
async function earlierFiles(): Promise<(hash: string) => Promise<Response | undefined>> {
  const found: Map<string, [Cache, string]> = new Map();
  for (const name of await releases()) {
    const cache = await caches.open(name);
    for (const [address, hash] of Object.entries(await filesOf(cache))) {
      found.set(hash, [cache, root + address]);
    }
  }
  return async (hash) => {
    const [cache, url] = found.get(hash) ?? [];
    return url === undefined ? undefined : cache?.match(url);
  };
}

async function filesOf(cache: Cache): Promise<Files> {
  return (await (await cache.match(LIST))?.json()) ?? {};
}

/** Names of the caches that hold this book. */
async function releases() {
  return (await caches.keys()).filter((name) => name.startsWith(PREFIX));
}

/**
 * What the release has under the address; else what an earlier one has, for a page of that; else
 * what the network says.
 */
async function answer(request: Request) {
  const { origin, pathname } = new URL(request.url);
  const url = origin + pathname.replace(/\/index\.html$/, "/");
  const own = await caches.open(OWN);
  const stored = await own.match(url);
  if (stored) return asAsked(stored, request);
  if (await own.match(`${url}/`)) return Response.redirect(`${url}/`);
  for (const name of await releases()) {
    const left = await (await caches.open(name)).match(url);
    if (left) return asAsked(left, request);
  }
  return fetch(request);
}

/**
 * The whole file, or the part that a film asks for (RFC 9110, section 14): some browsers take no
 * whole file for a part.
 */
async function asAsked(stored: Response, { headers }: Request): Promise<Response> {
  const [, first, last] = /^bytes=(\d+)-(\d*)$/.exec(headers.get("range") ?? "") ?? [];
  if (first === undefined || headers.has("if-range")) return stored;
  const file = await stored.clone().blob();
  const [start, end] = [Number(first), last ? Number(last) + 1 : file.size];
  const part = file.slice(start, end, stored.headers.get("content-type") ?? "");
  if (part.size === 0) return stored;
  const range = `bytes ${start}-${start + part.size - 1}/${file.size}`;
  return new Response(part, { status: 206, headers: { "content-range": range } });
}

/** Answer for all pages; drop earlier releases once no open page came from one. */
async function tidy() {
  await worker.clients.claim();
  const pages = await worker.clients.matchAll({ type: "window" });
  const own = Object.keys(await filesOf(await caches.open(OWN))).map((name) => root + name);
  if (!pages.every((page) => own.includes(assetsOf.get(page.id) ?? ""))) return;
  for (const name of await releases()) if (name !== OWN) await caches.delete(name);
  await caches.delete(`${root}#memory`); // of releases that stored an interpreter's memory
}

/** Give everything back, and have the pages come from the network again. */
async function leave() {
  for (const name of await releases()) await caches.delete(name);
  await worker.registration.unregister();
  const pages = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
  for (const page of pages) if (page.url.startsWith(root)) await page.navigate(page.url);
}
