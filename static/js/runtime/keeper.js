/**
 * A worker that has the memory of an interpreter kept for the next visit, and ends: one of its own,
 * as an interpreter that figures have used holds what belongs to them. Takes what `startInterpreter`
 * takes; answers whether there is now a memory.
 */

import { importSimulations } from "./interpreter.js";
import { loadedLibraries } from "./machine_code.js";
import { keepMemory } from "./memory.js";

/** @import { Wanted } from "./interpreter.js" */

/**
 * @param {Wanted} wanted
 * @returns {Promise<boolean>}
 */
async function keep(wanted) {
  const { url } = wanted;
  const { pyodide, parts, importMs, judge } = await importSimulations(wanted, undefined, {
    _makeSnapshot: true,
  });
  const { scenes, machine_code: machineCode } = parts.table;
  const needed = new Set(Object.values(scenes).flat());
  await parts.provide(parts.toRun([...needed].filter((part) => !machineCode.includes(part))));
  const before = loadedLibraries(pyodide);
  const simulations = pyodide.pyimport("simulations.browser");
  const found = JSON.parse(simulations.import_scenes(JSON.stringify(Object.keys(scenes))));
  simulations.destroy();
  if (loadedLibraries(pyodide).length > before.length) return false; // at a place of their own
  await judge();
  await keepMemory(url, pyodide.makeMemorySnapshot(), { scenes: found, importMs });
  return true;
}

self.onmessage = async ({ data }) => {
  try {
    self.postMessage(await keep(data));
  } catch {
    self.postMessage(false);
  }
};
