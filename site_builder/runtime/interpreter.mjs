/**
 * Runs a Python program in the pinned Pyodide, under Node: what it traces and compiles is then
 * right for the interpreter in the reader's browser.
 *
 * Arguments: the folder of Pyodide's files, the program, the folder that it sees as `/freezer`.
 */

import { readFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const [pyodideFolder, program, freezer] = process.argv.slice(2);
try {
  const { loadPyodide } = await import(pathToFileURL(`${pyodideFolder}/pyodide.mjs`).href);
  const pyodide = await loadPyodide({
    indexURL: `${pyodideFolder}/`,
    stdLibURL: `${pyodideFolder}/python.zip`,
    lockFileContents: await readFile(`${freezer}/lock.json`, "utf8"),
    env: {
      PYTHONHASHSEED: "0", // so that equal sources give equal bytes
      PYTHONNODEBUGRANGES: "1", // nobody sees in which column a library failed
    },
  });
  pyodide.mountNodeFS("/freezer", freezer);
  pyodide.runPython(await readFile(program, "utf8"));
} catch (error) {
  console.error(error.message); // not the line of Pyodide's script, which is all of it
  process.exitCode = 1;
}
