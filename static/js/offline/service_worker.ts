/**
 * Stores the whole book on the reader's device, a release at a time. The file `sw.js`, which the
 * builder writes, names the release and loads this one.
 *
 * A release is the list of its files in `offline.json`, each with the hash of its content; its name is
 * the hash of that list. All files are in one store, each under its hash, so releases share what they
 * have in common. A file is checked against its hash whenever it is read; one that is missing or
 * damaged is fetched and stored again. A worker is installed only once it has every file, so no page
 * gets the assets of another release. Pages that were open before keep the release that they came from.
 * Addresses are below the book's root; hashes are those of `integrity`.
 */

type Files = Map<string, string>;

const worker = self as unknown as ServiceWorkerGlobalScope;

/** The hash of this worker's list; empty where the book is not to be stored. */
const release = (self as unknown as { RELEASE: string }).RELEASE;
const root = worker.registration.scope;
const LIST = "offline.json";
const STORE = `files of ${root}`;
/** Begins the names of the caches that earlier versions of this script made, one for each release. */
const OLD_CACHE = `${root} `;
/** Files fetched at once: readers may be reading. */
const PARALLEL = 4;

const lists: Map<string, Promise<Files>> = new Map();
/** The open pages that came from this release, as far as this worker knows. */
const currentPages: Set<string> = new Set();
let isCleaned = false;
/** Whether a file was missing or damaged: others may be. */
let isDamaged = false;
let repair: Promise<unknown> | null = null;

worker.addEventListener("install", (event) => {
  const stored = release ? navigator.locks.request(STORE, installRelease) : Promise.resolve();
  event.waitUntil(stored.then(() => worker.skipWaiting()));
});
worker.addEventListener("activate", (event) => {
  event.waitUntil(release ? worker.clients.claim() : uninstall());
});
worker.addEventListener("fetch", (event) => {
  const { method, url, cache } = event.request;
  if (cache === "only-if-cached") return; // the browser's own copy, with what it compiled of it
  if (!release || method !== "GET" || !url.startsWith(root)) return;
  const reply = replyTo(event).catch(() => fetch(event.request));
  event.respondWith(reply);
  event.waitUntil(reply.then(() => tidyStore(event.clientId)).catch(() => {}));
});

/**
 * Store every file of the release, or fail; a later attempt fetches only what is missing. Under a lock,
 * so that no other worker deletes what this one stores.
 */
async function installRelease() {
  const store = await caches.open(STORE);
  await store.delete(keyOf(LIST, release)); // stored anew, it is the last list
  const failed = await storeAll().catch((error) => ({ address: LIST, error }));
  if (!failed) return;
  const isFull = failed.error instanceof DOMException;
  const problem = isFull ? failed.error.message : "";
  const pages = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
  for (const page of pages) page.postMessage({ address: root + failed.address, problem });
  if (isFull) await deleteOtherReleases((await releases()).filter((name) => name !== release));
  throw failed.error;
}

/** Store what is missing or damaged; a file that cannot be had does not stop the others. */
async function storeAll() {
  const left = [...(await filesOf(release))];
  const failed: { address: string; error: Error }[] = [];
  const take = async () => {
    for (let file = left.pop(); file; file = left.pop()) {
      const [address, hash] = file;
      await checkedFile(address, hash).catch((error) => {
        failed.push({ address, error });
        if (error instanceof DOMException) left.length = 0; // the store is full
      });
    }
  };
  await Promise.all(Array.from({ length: PARALLEL }, take));
  isDamaged = false;
  repair = null;
  return failed.at(-1);
}

/**
 * The file with this content, from the store or else from the network, which stores it.
 *
 * @param isTrusted Whether what is stored will do unchecked.
 */
async function checkedFile(address: string, hash: string, isTrusted = false): Promise<Response> {
  const store = await caches.open(STORE);
  const key = keyOf(address, hash);
  const stored = await store.match(key);
  if (stored && (isTrusted || (await hashOf(stored.clone()).catch(() => "")) === hash))
    return stored;
  const reply = await fetchChecked(root + address, hash);
  await store.put(key, reply.clone());
  isDamaged = true;
  return reply;
}

/** The last part of the address distinguishes files of one content and several types. */
function keyOf(address: string, hash: string) {
  const folder = address === LIST ? root : `${root}files/`;
  return `${folder}${address.slice(address.lastIndexOf("/") + 1)}?${hash}`;
}

async function hashOf(file: Response) {
  const digest = await crypto.subtle.digest("SHA-256", await file.arrayBuffer());
  return `sha256-${btoa(String.fromCharCode(...new Uint8Array(digest)))}`;
}

/**
 * Machine code is taken from the browser's cache, if it is there: a host that revalidates it would renew
 * it, and the browser drop its compiled code. The reply has no address, since scripts find their
 * neighbours by the address of the request.
 */
async function fetchChecked(url: string, hash: string) {
  const ask = (cache: RequestCache) => fetch(url, { cache, integrity: hash });
  const first = url.endsWith(".wasm") ? "force-cache" : "no-cache";
  const reply = await ask(first).catch(() => ask("reload")); // the browser's copy may be damaged
  if (!reply.ok) throw new Error(`${url} does not arrive: ${reply.status}`);
  const headers = new Headers(reply.headers);
  headers.delete("vary"); // the store has one copy of each file
  return new Response(reply.body, { headers });
}

/** The files of a release, and its list. */
function filesOf(name: string): Promise<Files> {
  const read = async () => {
    const files: Record<string, string> = await (await checkedFile(LIST, name)).json();
    return new Map([[LIST, name], ...Object.entries(files)]);
  };
  const files = lists.get(name) ?? read();
  lists.set(name, files);
  files.catch(() => lists.delete(name)); // a later request may find the network again
  return files;
}

/** The releases whose lists are stored, in the order in which they came. */
async function releases() {
  const store = await caches.open(STORE);
  const keys = await store.keys(root + LIST, { ignoreSearch: true });
  return keys.map(({ url }) => url.slice(url.indexOf("?") + 1));
}

/**
 * What the release has under the address; else what another one has, for a page of that; else what
 * the network sends. Scripts that fetch a file by its hash check it themselves, and try again.
 */
async function replyTo({ request, resultingClientId }: FetchEvent): Promise<Response> {
  const { origin, pathname, search } = new URL(request.url);
  const address = (origin + pathname).slice(root.length).replace(/(^|\/)index\.html$/, "$1");
  const { cache, destination, integrity } = request;
  const isChecked = cache === "default" && destination === "" && integrity !== "";
  const findIn = async (name: string) => {
    const files = await filesOf(name);
    const hash = files.get(address);
    if (hash !== undefined)
      return partialReply(await checkedFile(address, hash, isChecked), request);
    return files.has(`${address}/`) ? Response.redirect(`${root}${address}/${search}`) : null;
  };
  const found = await findIn(release);
  if (found && request.mode === "navigate") currentPages.add(resultingClientId);
  if (found) return found;
  for (const name of await releases()) {
    const left = await findIn(name).catch(() => null);
    if (left) return left;
  }
  return fetch(request);
}

/**
 * The whole file, or the part that a film requests (RFC 9110, section 14): some browsers take no
 * whole file for a part.
 */
async function partialReply(stored: Response, { headers }: Request): Promise<Response> {
  const [, first, last] = /^bytes=(\d+)-(\d*)$/.exec(headers.get("range") ?? "") ?? [];
  if (first === undefined || headers.has("if-range")) return stored;
  const file = await stored.clone().blob();
  const [start, end] = [Number(first), last ? Number(last) + 1 : file.size];
  const part = file.slice(start, end, stored.headers.get("content-type") ?? "");
  if (part.size === 0) return stored;
  const range = `bytes ${start}-${start + part.size - 1}/${file.size}`;
  return new Response(part, { status: 206, headers: { "content-range": range } });
}

/** After an answer to this page: mend the store, or drop the releases that no open page came from. */
async function tidyStore(page: string) {
  if (isDamaged) await (repair ??= storeAll());
  if (isCleaned || !currentPages.has(page)) return;
  const pages = await worker.clients.matchAll({ type: "window" });
  if (!pages.every(({ id }) => currentPages.has(id))) return;
  isCleaned = true;
  await navigator.locks.request(STORE, async () => {
    if ((await releases()).at(-1) === release) await deleteOtherReleases([release]);
  });
  for (const name of await caches.keys()) if (name.startsWith(OLD_CACHE)) await caches.delete(name);
}

/** Delete what belongs to no release of these. */
async function deleteOtherReleases(names: string[]) {
  const store = await caches.open(STORE);
  const files = (await Promise.all(names.map(filesOf))).flatMap((each) => [...each]);
  const keys = new Set(files.map(([address, hash]) => keyOf(address, hash)));
  for (const { url } of await store.keys()) if (!keys.has(url)) await store.delete(url);
}

/** Give everything back, and have the pages come from the network again. */
async function uninstall() {
  for (const name of await caches.keys()) {
    if (name === STORE || name.startsWith(OLD_CACHE)) await caches.delete(name);
  }
  await worker.registration.unregister();
  const pages = await worker.clients.matchAll({ type: "window", includeUncontrolled: true });
  for (const page of pages) if (page.url.startsWith(root)) await page.navigate(page.url);
}
