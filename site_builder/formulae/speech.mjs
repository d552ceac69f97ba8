/**
 * A formula in words, by the Speech Rule Engine (ClearSpeak). Its rules know school mathematics; what
 * is written otherwise here, such as products of matrices, is rewritten for them in `plainer.mjs`.
 */

import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { BEHIND, makePlainer } from "./plainer.mjs";

const STYLE =
  "AbsoluteValue_AbsEnd:Caps_SayCaps:Log_LnAsNaturalLog:Matrix_EndMatrix:TriangleSymbol_Delta";
/** What signs are called here and not by the engine, by code point. */
const SIGNS = {
  "203E": "bar",
  2192: "goes to",
  2219: "dot",
  "21D2": "which implies that",
  2217: "star",
  "223C": "is proportional to",
  2248: "is approximately",
  2272: "is less than or about",
  "22A4": "transpose",
  "27F6": "goes to",
  "2A2F": "cross",
};
/** What it says, and what we say. */
const REPLACED = [
  [/lamda/g, "lambda"],
  [/(?<=\b(?:the|end) )metric\b/g, "norm"],
  [/bold italic/g, "bold"],
  [/ slash /g, " over "],
  [/(?<=\bcap Delta) times/g, ""],
  [new RegExp(` times(?= (?:${BEHIND.join("|")})\\b)`, "g"), ""],
  [/\bat of (?=open)/g, "at "],
  [/(?<!\bcap )\b[A-Z]\b/g, "cap $&"],
  [/\s+/g, " "],
];

/**
 * The function that says a `<math>` element in English, given the `require` of the packages' folder;
 * what the engine cannot say is an empty text.
 * @param {NodeJS.Require} require
 */
export async function speaker(require) {
  const engine = require("speech-rule-engine/js/index.js");
  const {
    SemanticHeuristics,
  } = require("speech-rule-engine/js/semantic_tree/semantic_heuristic_factory.js");
  SemanticHeuristics.blacklist.simpleNamedFunction = true; // f, g and h are functions everywhere
  keepExpressions(require);
  const program = require.resolve("speech-rule-engine");
  const { DOMParser, XMLSerializer } = createRequire(program)("@xmldom/xmldom");
  await engine.setupEngine({
    locale: "en",
    domain: "clearspeak",
    style: STYLE,
    custom: async (/** @type {string} */ locale) =>
      withOurSigns(await readFile(join(dirname(program), "mathmaps", `${locale}.json`), "utf8")),
  });
  await engine.engineReady();
  return (/** @type {string} */ mathml) => {
    const tree = new DOMParser().parseFromString(mathml, "text/xml").documentElement;
    makePlainer(tree);
    const said = engine.toSpeech(new XMLSerializer().serializeToString(tree)) ?? "";
    return REPLACED.reduce((text, [theirs, ours]) => text.replace(theirs, ours), said).trim();
  };
}

/**
 * Have the engine parse each XPath expression of its rules once, and not wherever a rule is tried.
 *
 * @param {NodeJS.Require} require
 */
function keepExpressions(require) {
  const { SystemExternal } = require("speech-rule-engine/js/common/system_external.js");
  const { xpath } = require("speech-rule-engine/js/common/xpath_util.js");
  const kept = new Map();
  xpath.evaluate = (text, node, resolver, type) => {
    if (!kept.has(text)) kept.set(text, SystemExternal.xpath.createExpression(text, resolver));
    return kept.get(text).evaluate(node, type);
  };
}

/** @param {string} json the engine's signs and rules of a language */
function withOurSigns(json) {
  const maps = JSON.parse(json);
  for (const sign of Object.values(maps).filter(Array.isArray).flat())
    if (sign.key in SIGNS) sign.mappings = { default: { default: SIGNS[sign.key] } };
  for (const name of Object.keys(maps).filter((key) => /clearspeak_(base|english)/.test(key)))
    mend(maps[name].rules);
  return maps;
}

const SIMPLE = 'contains(children/*[1]/@annotation, "clearspeak:simple")';
/** What its rules leave out: only parentheses are silent around a letter or number, and rounding and
 * numbers of choices have words of their own. */
function mend(rules) {
  for (const rule of rules) {
    if (/^paren-simple(-exp)?$/.test(rule[1]) && rule[0] === "Precondition")
      rule.push('content/*[1]/text()="("');
    if (rule[1] === "binomial" && rule[0] === "Precondition") rule[2] = "Matrix_EndMatrix";
  }
  const hasActions = rules.some((rule) => rule[0] === "Action" && rule[1] === "paren-simple");
  const hasConditions = rules.some((rule) => rule[1] === "paren-simple" && rule[0] !== "Action");
  for (const [sign, name] of [
    ["⌊", "floor"],
    ["⌈", "ceiling"],
  ]) {
    const is = ["self::fenced", '@role="leftright"', `content/*[1]/text()="${sign}"`];
    const begin = `[t] "the ${name} of"; [n] children/*[1]`;
    if (hasConditions) {
      rules.push(["Precondition", name, "default", ...is]);
      rules.push(["Precondition", `${name}-simple`, "default", ...is, SIMPLE]);
    }
    if (hasActions) {
      rules.push(["Action", name, `${begin}; [t] "end ${name}"`]);
      rules.push(["Action", `${name}-simple`, begin]);
    }
  }
}
