/**
 * Loads what the worker needs beside the interpreter: the simulations, Python's library and numpy, in
 * chunks that `runtime.json` lists. Imports of the page's first scene are fetched while the
 * interpreter starts, those of its others once that is drawn; anything else when Python imports it.
 */

import { LoadError, fetchWhole, findLoadError } from "./load_error.ts";

/** Python's library, which stays an archive. */
const LIBRARY = "python";
/** The sources of all simulations, for those who edit them; `simulations/editing/` looks for them. */
export const SOURCES = "simulations";
const TABLE = "runtime.json";
/** Taken before Python runs, which may change or lose them. */
const { XMLHttpRequest } = globalThis;
const { hasOwn } = Object;

/** The content of `runtime.json`. */
interface Table {
  integrity: Record<string, string>;
  scenes: Record<string, string[]>;
  ladders: Record<string, string[]>;
  modules: Record<string, string>;
  lock: object;
  folder: string;
  library: string;
  libraries: Record<string, string>;
  machine_code: string[];
}

export class Chunks {
  #arriving: Map<string, Promise<Uint8Array>> = new Map();
  #present: Set<string> = new Set();
  /** The interpreter into which chunks are unpacked: Pyodide has no types here. */
  pyodide: any = null;
  /** Whether the interpreter continued from a snapshot, which has the modules but not their files. */
  hasSnapshot = false;
  /** What further scenes of the page import: fetched once a figure is drawn. */
  later: string[] = [];
  /** Why Python's last import of a module failed. */
  missed: LoadError | null = null;
  /** Chunks that Python's imports lacked, where a worker can fetch none at once. */
  lacking: string[] = [];
  /** Has the page fetch a chunk, for a worker that may fetch nothing itself. */
  fetchByPage: ((name: string) => Promise<ArrayBuffer>) | null = null;

  /** @param url The runtime's folder. */
  constructor(
    readonly url: string,
    readonly table: Table,
  ) {}

  /**
   * @param url The runtime's folder.
   * @param integrity Hash of the table, as the page knows it.
   * @param fresh Whether to bypass the HTTP cache, which may hold a damaged table.
   * @throws {LoadError}
   */
  static async fetchTable(url: string, integrity?: string, fresh?: boolean): Promise<Chunks> {
    const reply = await fetchWhole(url + TABLE, integrity, fresh ? ["reload"] : undefined);
    try {
      return new Chunks(url, await reply.json());
    } catch {
      throw await findLoadError(url + TABLE);
    }
  }

  /**
   * The reply with a whole file.
   *
   * @throws {LoadError}
   */
  reply(name: string): Promise<Response> {
    return fetchWhole(this.url + name, this.table.integrity[name]);
  }

  /** Begin to fetch chunks. */
  prefetch(names: string[]) {
    for (const name of names) {
      if (this.#present.has(name) || this.#arriving.has(name)) continue;
      const arriving = this.#fetch(name).then((archive) => new Uint8Array(archive));
      arriving.catch(() => {}); // reported to whoever needs it
      this.#arriving.set(name, arriving);
    }
  }

  /** All chunks that running needs: those of a scene or ladder, and what all build on. */
  chunksToRun(names: string[]) {
    return [...(this.hasSnapshot ? [LIBRARY] : []), "numpy", "core", ...names];
  }

  /**
   * The chunks that importing a scene needs. Where a snapshot has the modules already, their files
   * come later, and so does machine code, which frames import.
   */
  chunksToImport(scene: string) {
    const names = this.table.scenes[scene] ?? [];
    if (!this.hasSnapshot) return this.chunksToRun(names);
    return names.filter((name) => !this.table.machine_code.includes(name));
  }

  isMissingAny(names: string[]) {
    return !names.every((name) => this.#present.has(name));
  }

  /**
   * Fetch and unpack chunks. One that does not arrive is requested again when it is next needed.
   *
   * @throws {LoadError}
   */
  async provide(names: string[]) {
    this.prefetch(names);
    for (const name of names) {
      const arriving = this.#arriving.get(name);
      this.#arriving.delete(name);
      const archive = await arriving;
      if (archive) this.#unpack(name, archive);
    }
  }

  /**
   * Fetch and unpack a chunk at once: Python is in the midst of importing from it. Where only the page
   * fetches, the chunk is noted as lacking.
   *
   * @throws {LoadError} Also kept in `missed`, as Python reports another error.
   */
  fetchSynchronously(name: string) {
    if (typeof name !== "string" || this.#present.has(name)) return;
    if (!hasOwn(this.table.integrity, `${name}.zip`)) return;
    if (this.fetchByPage) {
      this.lacking.push(name);
      throw new LoadError("network", `${name}.zip`);
    }
    try {
      this.#unpack(name, loadSynchronously(`${this.url}${name}.zip`));
    } catch (error) {
      this.missed = error instanceof LoadError ? error : new LoadError("other", `${name}.zip`);
      throw this.missed;
    }
  }

  async #fetch(name: string) {
    if (this.fetchByPage) return await this.fetchByPage(name);
    return await (await this.reply(`${name}.zip`)).arrayBuffer();
  }

  #unpack(name: string, archive: Uint8Array) {
    if (this.#present.has(name)) return;
    const { FS } = this.pyodide;
    const { folder, library } = this.table;
    if (name === LIBRARY) FS.writeFile(library, archive);
    else if (name === SOURCES) FS.writeFile(`/lib/${name}.zip`, archive);
    else this.pyodide.unpackArchive(archive, "zip", { extractDir: folder });
    this.#present.add(name);
  }
}

/**
 * An archive, by a synchronous request.
 *
 * @throws {LoadError}
 */
function loadSynchronously(url: string): Uint8Array {
  const request = new XMLHttpRequest();
  request.open("GET", url, false);
  request.responseType = "arraybuffer";
  try {
    request.send();
  } catch {
    throw new LoadError("network", url);
  }
  if (request.status !== 200) throw new LoadError("status", url, String(request.status));
  const archive = new Uint8Array(request.response);
  if (archive[0] === "<".charCodeAt(0)) throw new LoadError("page", url);
  return archive;
}
