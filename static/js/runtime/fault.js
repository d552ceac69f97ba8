/**
 * Files of the runtime that do not come, or come wrong: which one, and in what way. The worker
 * tells it as data; the page has the words.
 */

/**
 * `network`: no answer, or half of one. `status`: an answer that refuses. `page`: a web page in
 * place of the file, as networks send that ask one to sign in. `other`: not the file of this book.
 * `type`: a script that the host calls something else, so that browsers refuse it.
 *
 * @typedef {"network" | "status" | "page" | "other" | "type"} FaultKind
 * @typedef {{kind: FaultKind, file: string, detail: string}} Told
 */

/** The browser's own: the worker has what Pyodide asks for answered by these replies. */
const ask = globalThis.fetch;

/** The browser's own copy or nothing: it is to be had only by pages of the same origin. */
export const OWN_COPY = "only-if-cached";

export class Fault extends Error {
  /**
   * @param {FaultKind} kind
   * @param {string} url
   * @param {string} [detail] The status, or the type.
   */
  constructor(kind, url, detail = "") {
    const file = url.slice(url.lastIndexOf("/") + 1);
    super([file, kind, detail].filter(Boolean).join(" "));
    /** @type {Told} */
    this.told = { kind, file, detail };
  }
}

/**
 * Files of which the browser's cache held a damaged copy, by address.
 *
 * @type {Set<string>}
 */
export const replaced = new Set();

/**
 * The reply with a file that is whole and the right one. A damaged copy in the browser's cache is
 * replaced.
 *
 * @param {string} url
 * @param {string} [integrity] Its hash; without one only what is plainly wrong is noticed.
 * @param {RequestCache[]} [caches] How it is asked for, one way after the other.
 * @returns {Promise<Response>}
 * @throws {Fault}
 */
export async function fetchWhole(url, integrity, caches = ["default", "reload"]) {
  for (const cache of caches) {
    try {
      const mode = cache === OWN_COPY ? "same-origin" : "cors";
      const reply = await ask(url, { cache, integrity, mode });
      if (!reply.ok) throw new Fault("status", url, String(reply.status));
      checkType(reply);
      return reply;
    } catch (error) {
      if (error instanceof Fault) throw error;
      replaced.add(url);
    }
  }
  throw await findFault(url);
}

/**
 * What is wrong with a file, by looking at what the host sends now.
 *
 * @param {string} url
 * @returns {Promise<Fault>} Of kind `other` where nothing else is found.
 */
export async function findFault(url) {
  try {
    const reply = await ask(url, { cache: "reload" });
    if (!reply.ok) return new Fault("status", url, String(reply.status));
    const begins = new Uint8Array(await reply.arrayBuffer()).subarray(0, 256);
    if (/^\s*</.test(new TextDecoder().decode(begins))) return new Fault("page", url);
    checkType(reply);
    return new Fault("other", url);
  } catch (error) {
    return error instanceof Fault ? error : new Fault("network", url);
  }
}

/**
 * A script must be called one; of anything else the type does not matter.
 *
 * @param {Response} reply
 */
function checkType(reply) {
  const type = reply.headers.get("content-type") ?? "";
  if (/\.m?js$/.test(reply.url) && !/javascript|ecmascript/.test(type)) {
    throw new Fault(type.startsWith("text/html") ? "page" : "type", reply.url, type);
  }
}
