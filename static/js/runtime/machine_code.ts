/** Machine code (WebAssembly) of the interpreter and its libraries. */

import { trackArrival, fetchWhole } from "./load_error.ts";

/**
 * Compile a file while it arrives. The browser caches the compiled code with its own copy of the file,
 * not with the service worker's, which passes on requests for only that copy.
 *
 * @param integrity Its hash, needed where the file does not compile.
 * @param cached Whether the browser may have a copy.
 * @param fresh Whether that may be damaged.
 * @throws {import("./load_error.ts").LoadError}
 */
export async function compileFile(
  url: string,
  integrity: () => Promise<string>,
  cached: boolean,
  fresh: boolean,
): Promise<WebAssembly.Module> {
  const caches: RequestCache[] = fresh ? [] : cached ? ["only-if-cached", "default"] : ["default"];
  for (const cache of caches) {
    try {
      const reply = fetch(url, { cache, mode: "same-origin" });
      return await trackArrival(url, WebAssembly.compileStreaming(reply));
    } catch {
      // The next way: there is no copy, or it is damaged, or of another media type.
    }
  }
  const file = await fetchWhole(url, await integrity(), ["reload"]);
  return WebAssembly.compile(await file.arrayBuffer());
}

/**
 * Load libraries before Python runs, always in the same order: so each has the same place in the
 * memory of every interpreter, and a snapshot that refers to it is valid in all of them.
 *
 * @param settings Emscripten's, of the interpreter to be created.
 * @returns Rejects where one cannot be loaded.
 */
export function preload(
  settings: any,
  libraries: [path: string, module: WebAssembly.Module][],
): Promise<never> {
  return new Promise((_, reject) => {
    const load = async () => {
      const hasTrampoline = settings.HEAP32[trampolineAt(settings) / 4] !== 0;
      if (!hasTrampoline) settings.wasmTable.grow(1); // libraries have their places after it
      for (const [path, module] of libraries) {
        const options = { loadAsync: true, nodelete: true };
        const loaded = await settings.loadWebAssemblyModule(module, options, path, {});
        settings.preloadedWasm[path] = loaded;
      }
      settings.removeRunDependency("libraries");
    };
    settings.preRun.unshift(() => {
      settings.addRunDependency("libraries");
      load().catch(reject);
    });
  });
}

/**
 * Where in memory the place of Python's trampoline in the table of functions is kept. CPython has one
 * where the browser can compile it, and on no iPhone or iPad, where it keeps zero
 * (`Python/emscripten_trampoline.c`).
 *
 * @param module Emscripten's.
 */
export function trampolineAt(module: any): number {
  const offset = module.HEAP32[module.__PyEM_EMSCRIPTEN_TRAMPOLINE_OFFSET / 4];
  return module.__PyRuntime + offset;
}
