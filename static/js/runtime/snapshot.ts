/**
 * The snapshot of an interpreter that has started and imported what most scenes share. The book ships
 * it as a module of WebAssembly whose data is what the start of Python changes in memory, and which
 * writes that data as it is instantiated.
 */

import type { Chunks } from "./chunks.ts";
import { hasOneObjectPerFunction } from "./engine_features.ts";
import { trampolineAt } from "./machine_code.ts";

const FILE = "snapshot.wasm";
/**
 * The module's section with JSON: the size of the memory, Pyodide's references into it, and the length
 * of the table of functions.
 */
const SECTION = "about";

/** The snapshot did not arrive whole, or cannot be restored: Python can start plainly. */
export class SnapshotError extends Error {}

/** @returns Null where the book ships none, or the engine cannot continue from it. */
export function fetchSnapshot(chunks: Chunks): Promise<WebAssembly.Module> | null {
  if (!(FILE in chunks.table.integrity) || !hasOneObjectPerFunction()) return null;
  const compiling = chunks
    .reply(FILE)
    .then(async (reply) => WebAssembly.compile(await reply.arrayBuffer()));
  compiling.catch(() => {}); // reported when it is restored
  return compiling;
}

/**
 * Have an interpreter that is being created continue from the snapshot instead of starting.
 *
 * @param module Emscripten's, created with an empty `_loadSnapshot`.
 * @throws {SnapshotError}
 */
export async function restore(module: any, arriving: Promise<WebAssembly.Module>) {
  try {
    const snapshot = await arriving;
    const [section] = WebAssembly.Module.customSections(snapshot, SECTION);
    const { size, references, table } = JSON.parse(new TextDecoder().decode(section));
    if (module.wasmTable.length !== table) throw new Error("functions have other places");
    if (module.HEAP8.length < size) module.growMemory(size);
    module.API.restoreSnapshot = () => {
      const trampoline = module.HEAP32[trampolineAt(module) / 4];
      new WebAssembly.Instance(snapshot, { python: { memory: module.memory } });
      module.HEAP32[trampolineAt(module) / 4] = trampoline;
      return references;
    };
  } catch (error) {
    throw new SnapshotError("no snapshot", { cause: error });
  }
}
