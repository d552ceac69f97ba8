/**
 * Answers each line of its input, a request as JSON, with a line of its own, until the input ends.
 * Called with the folder of the packages. A formula that is spoken has words as its `alttext`.
 *
 *   {"tex": "…", "display": true, "spoken": true, "macros": {"\\R": "…"}}
 *   {"mathml": "…"} or {"error": "…", "position": 3}
 */

import { createRequire } from "node:module";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { speaker } from "./speech.mjs";

const require = createRequire(join(process.argv[2], "node_modules", "/"));
const temml = require("temml/dist/temml.cjs");
globalThis.temml = temml;
require("temml/contrib/mhchem/mhchem.js");

const OPTIONS = {
  throwOnError: true,
  strict: false,
  trust: (context) => context.command === "\\class" && /^role-[\w-]+$/.test(context.class),
  maxExpand: 1000,
};
/** What our style sheet does instead: a formula's display, and the spaces between columns. */
const OURS = [
  [/ class="tml-display" style="display:block math;"/g, ""],
  [/padding-(?:left|right):[\d.]+(?:em|pt);/g, ""],
  [/ style=""/g, ""],
];

/** @param {{tex: string, display: boolean, macros: Record<string, string>}} request */
function set({ tex, display, macros }) {
  const mathml = temml.renderToString(tex, { ...OPTIONS, displayMode: display, macros });
  return OURS.reduce((text, [found, other]) => text.replaceAll(found, other), mathml);
}

let say;
/** With words, unless the engine has none. @param {string} mathml */
async function spoken(mathml) {
  say ??= await speaker(require);
  const words = say(mathml).replace(/[&"<]/g, (sign) => `&#${sign.charCodeAt(0)};`);
  return words ? mathml.replace("<math", () => `<math alttext="${words}"`) : mathml;
}

async function answer(request) {
  try {
    const mathml = set(request);
    return { mathml: request.spoken ? await spoken(mathml) : mathml };
  } catch (error) {
    if (error.name !== "ParseError") return { error: "a part of it is missing" };
    const [reason] = error.message.trim().split(/ at (?:position \d|end of input)/);
    return { error: reason.replaceAll("'EOF'", "its end"), position: error.position ?? 0 };
  }
}

for await (const line of createInterface({ input: process.stdin })) {
  process.stdout.write(`${JSON.stringify(await answer(JSON.parse(line)))}\n`);
}
