/** Starts the Python interpreter, with the simulations imported. */

import { Chunks } from "./chunks.ts";
import { LoadError } from "./load_error.ts";
import { compileFile, preload } from "./machine_code.ts";
import type { StartRequest } from "./messages.ts";
import { SnapshotError, fetchSnapshot, restore } from "./snapshot.ts";

const SCRIPTS = ["pyodide.mjs", "pyodide.asm.mjs"];
const MACHINE_CODE = "pyodide.asm.wasm";
const LIBRARY = "python.zip";

/**
 * Continue from the snapshot that the book ships, or start plainly where that fails.
 *
 * @returns `python`: the module `simulations.browser`.
 * @throws {import("./load_error.ts").LoadError}
 */
export async function startInterpreter(
  request: StartRequest,
): Promise<{ chunks: Chunks; python: any }> {
  const fromSnapshot = !request.fresh && !request.plain;
  try {
    return await start(request, fromSnapshot);
  } catch (error) {
    if (!fromSnapshot || error instanceof LoadError) throw error;
    console.warn(error instanceof SnapshotError ? error.cause : error);
    return start(request, false);
  }
}

/**
 * All files are fetched at once, each being checked as it arrives.
 *
 * @param fromSnapshot Whether to continue from the snapshot, where the book ships one.
 */
async function start(request: StartRequest, fromSnapshot: boolean) {
  const { url, table: hash, scenes, cached = false, fresh = false } = request;
  const listing = Chunks.fetchTable(url, hash, fresh);
  const compile = (name: string) => {
    const integrity = async () => (await listing).table.integrity[name];
    return compileFile(url + name, integrity, cached, fresh);
  };
  const compiling = compile(MACHINE_CODE);
  compiling.catch(() => {}); // reported below
  const chunks = await listing;
  const { table } = chunks;
  const libraries = Object.entries(table.libraries).map(
    async ([name, path]) =>
      [`${table.folder}/${path}`, await compile(name)] as [string, WebAssembly.Module],
  );
  const scripts = SCRIPTS.map(async (name) => (await chunks.reply(name)) && import(url + name));
  const files = Promise.all([Promise.all(scripts), compiling, Promise.all(libraries)]);
  files.catch(() => {}); // likewise
  const snapshot = fromSnapshot ? fetchSnapshot(chunks) : null;
  chunks.hasSnapshot = snapshot !== null;
  if (!snapshot) chunks.prefetch(chunks.chunksToRun([]));
  const [first, ...others] = scenes.map((scene) => chunks.chunksToImport(scene));
  chunks.prefetch(first ?? []);
  chunks.later = others.flat();
  const library = snapshot ? new Response() : await chunks.reply(LIBRARY);
  const [[{ loadPyodide }, { default: createPyodideModule }], machineCode, loaded] = await files;
  interceptRequests(
    { [url + MACHINE_CODE]: new Response(), [url + LIBRARY]: library },
    machineCode,
  );
  const pyodide = await loadPyodide({
    indexURL: url,
    stdLibURL: url + LIBRARY,
    stdin: () => null, // `input()` finds the end of a file
    lockFileContents: JSON.stringify(table.lock),
    async createPyodideModule(settings: any) {
      const failed = preload(settings, loaded);
      const module = await Promise.race([createPyodideModule(settings), failed]);
      if (snapshot) await restore(module, snapshot);
      return module;
    },
    ...(snapshot ? { _loadSnapshot: new Uint8Array() } : {}),
  });
  chunks.pyodide = pyodide;
  if (snapshot) pyodide.runPython("import random; random.seed()");
  else await chunks.provide(chunks.chunksToRun([]));
  const python = pyodide.pyimport("simulations.browser");
  const fetchSynchronously = (name: string) => chunks.fetchSynchronously(name);
  python.fetch_missing(JSON.stringify(table.modules), fetchSynchronously, table.folder);
  return { chunks, python };
}

/**
 * Answer Pyodide's requests by files that have been fetched and compiled.
 *
 * @param replies By address.
 * @param machineCode Of the interpreter.
 */
function interceptRequests(replies: Record<string, Response>, machineCode: WebAssembly.Module) {
  const fetchOther = self.fetch;
  self.fetch = async (address, options) => {
    return replies[String(address)] ?? fetchOther(address, options);
  };
  WebAssembly.instantiateStreaming = async (_, imports) => {
    const instance = await WebAssembly.instantiate(machineCode, imports);
    return { module: machineCode, instance };
  };
}
