/** Files of the runtime that do not arrive, or arrive wrong: which one, and in what way. */

/**
 * `network`: no answer, or half of one. `status`: an answer that refuses. `page`: a web page in
 * place of the file, as networks send that ask for a login. `other`: not the file of this book.
 * `type`: a script under a media type that browsers refuse.
 */
export type LoadErrorKind = "network" | "status" | "page" | "other" | "type";

export type LoadErrorData = { kind: LoadErrorKind; file: string; detail: string };

export class LoadError extends Error {
  /** What the worker sends to the page. */
  readonly data: LoadErrorData;

  /** @param detail The status, or the type. */
  constructor(kind: LoadErrorKind, url: string, detail: string = "") {
    const file = fileOf(url);
    super([file, kind, detail].filter(Boolean).join(" "));
    this.data = { kind, file, detail };
  }
}

/** The browser's own: the worker answers what Pyodide requests, and then lets no Python fetch. */
const { fetch: fetchFile, Response } = globalThis;

/** Files that were requested and have not arrived, the earliest first. */
export const pendingFiles: Set<string> = new Set();

/** The file at `url` as it arrives; one of `pendingFiles` until then. */
export async function trackArrival<T>(url: string, arriving: Promise<T>): Promise<T> {
  const file = fileOf(url);
  pendingFiles.add(file);
  try {
    return await arriving;
  } finally {
    pendingFiles.delete(file);
  }
}

/**
 * The reply with a whole file. A damaged copy in the browser's cache is replaced.
 *
 * @param integrity Its hash; without one, only evident errors are noticed.
 * @param caches Cache modes to try in turn.
 * @throws {LoadError}
 */
export async function fetchWhole(
  url: string,
  integrity?: string,
  caches: RequestCache[] = ["default", "reload"],
): Promise<Response> {
  for (const cache of caches) {
    try {
      return await trackArrival(url, fetchOnce(url, { cache, integrity }));
    } catch (error) {
      if (error instanceof LoadError) throw error;
    }
  }
  throw await findLoadError(url);
}

/**
 * A chunk for a worker that may fetch nothing itself: one that `runtime.json` lists.
 *
 * @param url The runtime's folder.
 * @param integrity Hash of its table, as the page knows it.
 * @throws {LoadError}
 */
export async function fetchListed(url: string, name: string, integrity?: string) {
  const { integrity: hashes } = await (await fetchWhole(`${url}runtime.json`, integrity)).json();
  const file = `${name}.zip`;
  if (!Object.hasOwn(hashes, file)) throw new LoadError("other", file);
  return await (await fetchWhole(url + file, hashes[file])).arrayBuffer();
}

/** The reply, once all of it is there. */
async function fetchOnce(url: string, options: RequestInit) {
  const reply = checkReply(await fetchFile(url, options));
  return new Response(await reply.arrayBuffer(), { headers: reply.headers });
}

/**
 * What is wrong with a file, by what the host sends now.
 *
 * @returns Of kind `other` where nothing else is found.
 */
export async function findLoadError(url: string): Promise<LoadError> {
  try {
    const reply = await fetchFile(url, { cache: "reload" });
    const start = (await reply.clone().text()).slice(0, 256);
    if (reply.ok && /^\s*</.test(start)) return new LoadError("page", url);
    checkReply(reply);
    return new LoadError("other", url);
  } catch (error) {
    return error instanceof LoadError ? error : new LoadError("network", url);
  }
}

function fileOf(url: string) {
  const [file] = /[^/]*\/?$/.exec(url) ?? [""];
  return file;
}

/** @throws {LoadError} Where it refuses, or is a script with a media type that browsers refuse. */
function checkReply(reply: Response) {
  if (!reply.ok) throw new LoadError("status", reply.url, String(reply.status));
  const type = reply.headers.get("content-type") ?? "";
  if (/\.m?js$/.test(reply.url) && !/javascript|ecmascript/.test(type)) {
    throw new LoadError(type.startsWith("text/html") ? "page" : "type", reply.url, type);
  }
  return reply;
}
