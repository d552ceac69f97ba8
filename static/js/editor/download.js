/** The reader's texts as a file. */

import { nameOf } from "./sources.js";

/** @import { Edits } from "./edits.js" */

/**
 * Hand the reader's texts over as a file.
 *
 * @param {string} scene
 * @param {Edits} edits
 */
export function download(scene, edits) {
  const pieces = [...edits.all].map(([key, { text }]) => {
    const [module, name] = [key.slice(0, key.indexOf(":")), nameOf(key)];
    return `# ${name} in ${module.replaceAll(".", "/")}.py\n\n${text}\n`;
  });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([pieces.join("\n\n")], { type: "text/x-python" }));
  link.download = `${scene}-edited.py`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
