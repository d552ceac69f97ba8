/**
 * MathML as the Speech Rule Engine understands it: what depends on the field, or on TeX, is written
 * by other elements. Nobody sees the result.
 */

const MATHML = "http://www.w3.org/1998/Math/MathML";
const UNITS = { m: "metres", mm: "millimetres", µm: "micrometres", px: "pixels", s: "seconds" };
/** What TeX sets over letters as spacing characters, and what the engine reads there. */
const ACCENTS = { ˆ: "^", "˜": "~" };
const BOLD = /[\u{1D400}-\u{1D433}\u{1D6A8}-\u{1D6E1}\u{1D71C}-\u{1D755}]/u;
/** A function where parentheses follow at once: these letters, and names of several letters. */
const FUNCTION = /^([fgh]|\p{L}{2,}\d?)$/u;
const ROWS = "mrow|math|mtd|msqrt|mstyle|mpadded";
const [INVISIBLE_TIMES, APPLY, CROSS, DOT] = ["\u2062", "\u2061", "⨯", "∙"];
const PASSES = [
  [rows, units, evaluations],
  [tokens, accents, scripts, digits, products, bars, lines, ending],
];

/** Words behind what they belong to, which the engine would take for a factor. */
export const BEHIND = [
  "vector",
  "transpose",
  "inverse",
  "conjugate",
  "star",
  "at",
  "from",
  "to",
  "percent",
  ...Object.values(UNITS),
];

/** Change the tree below a node. */
export function makePlainer(node) {
  for (const rules of PASSES) apply(rules, node);
}

/** Inner parts first. */
function apply(rules, node) {
  for (const child of children(node)) apply(rules, child);
  for (const rule of rules) rule(node);
}

/** Without what is empty, and without rows of one. */
function rows(node) {
  for (const child of children(node)) {
    if (is(child, "mspace") && !child.hasAttribute("width")) node.removeChild(child);
    if (is(child, "mrow") && children(child).length === 1) swap(child, children(child)[0]);
  }
}

/** Signs that TeX sets as letters, and upright letters, which the engine would call "normal". */
function tokens(node) {
  for (const child of children(node)) {
    if (is(child, "mi|mtext", /^\p{L}$/u)) swap(child, element(child, "mi", text(child)));
    if (is(child, "mi|mo", /^%$/)) swap(child, element(child, "mtext", "percent"));
    if (is(child, "mi", /^[/|.]$/)) swap(child, element(child, "mo", text(child)));
  }
}

function accents(node) {
  if (!is(node, "mover")) return;
  const [base, accent] = children(node);
  if (text(accent) === "→")
    swap(node, element(node, "mrow", base, element(node, "mtext", "vector")));
  else accent.textContent = ACCENTS[text(accent)] ?? text(accent);
}

/** A bar with limits: what stands before it is taken at a place, or from one to another. */
function evaluations(node) {
  if (!is(node, "msub|msubsup")) return;
  const [base, ...limits] = children(node);
  const parts = is(base, "mo") ? [base] : children(base).filter(text);
  const before = children(node.parentNode);
  const others = [...parts.slice(0, -1), ...before.slice(0, before.indexOf(node))];
  const isBar = (part) => is(part, "mo", /^[|∣]$/);
  if (!isBar(parts.at(-1)) || others.filter(isBar).length % 2) return; // of a norm
  const words = limits.length > 1 ? ["from", "to"] : ["at"];
  const said = limits.flatMap((limit, place) => [element(node, "mo", words[place]), limit]);
  swap(node, element(node, "mrow", ...parts.slice(0, -1), ...said));
}

/** Degrees, transposes, inverses and conjugates are no powers; an index such as 12 is two numbers. */
function scripts(node) {
  if (!is(node, "msup|msubsup|msub")) return;
  const [base, ...rest] = children(node);
  const below = is(node, "msup") ? null : rest[0];
  if (below && text(below) === "×") below.textContent = "cross";
  if (is(base, "mi", /^.$/u) && is(below, "mn", /^[1-4]{2}$/))
    below.textContent = [...text(below)].join(" ");
  if (is(node, "msub")) return;
  const [prime, ...power] = children(rest.at(-1));
  const primed = is(prime, "mo", /^′+$/) && power.length > 0;
  const word = wordOf(primed ? power.map(text).join("") : text(rest.at(-1)), text(base));
  if (!primed && !word) return;
  let bare = below ? element(node, "msub", base, below) : base;
  if (primed) bare = element(node, "msup", bare, prime);
  if (word) swap(node, element(node, "mrow", bare, element(node, "mtext", word)));
  else swap(node, element(node, "msup", bare, element(node, "mrow", ...power)));
}

function wordOf(power, base) {
  if (/^[∘°]$/.test(power)) return base === "1" ? "degree" : "degrees";
  if (power === "⊤" || power === "𝖳") return "transpose";
  if (power === "T" && (/^[\p{Lu}([]/u.test(base) || BOLD.test(base))) return "transpose";
  if (power === "−⊤") return "inverse transpose";
  if (power === "−1" && !/^[\d.a-z]+$/.test(base)) return "inverse";
  if (power === "∗") return BOLD.test(base) ? "conjugate" : "star";
  return "";
}

/** `10\,000` is one number. */
function digits(node) {
  for (const space of children(node)) {
    const [before, after] = [space.previousSibling, space.nextSibling];
    if (!is(space, "mspace") || !is(before, "mn", /^\d{1,3}$/) || !is(after, "mn", /^\d{3}\b/))
      continue;
    before.textContent += text(after);
    node.removeChild(space);
    node.removeChild(after);
  }
}

/** Names of units; spaces set as text go. */
function units(node) {
  if (!is(node, ROWS)) return;
  for (const child of children(node).slice(1)) {
    if (is(child, "mtext", /^$/)) node.removeChild(child);
    else if (isUpright(child) && text(child) in UNITS && follows(child, /[\d)]$/))
      swap(child, element(child, "mtext", UNITS[text(child)]));
  }
}

const isUpright = (node) =>
  is(node, "mtext") ||
  is(node, "mi", /../u) ||
  (is(node, "mi") && node.getAttribute("mathvariant") === "normal");

function follows(node, pattern) {
  let before = node.previousSibling;
  while (is(before, "mspace")) before = before.previousSibling;
  return Boolean(before) && pattern.test(text(before));
}

/** Products of vectors; functions, and products that a thin space tells from them. */
function products(node) {
  if (!is(node, ROWS)) return;
  for (const child of children(node)) {
    const [before, after] = [child.previousSibling, child.nextSibling];
    if (is(child, "mo", /^×$/) && (isVector(before) || isVector(after))) child.textContent = CROSS;
    if (
      is(child, "mo", /^⋅$/) &&
      isVector(before) &&
      (isVector(after) || is(after, "mi|msub|mrow", /^\p{L}/u))
    )
      child.textContent = DOT;
    if (!is(child, "mi|msub|msup|msubsup|mover")) continue;
    const spaced = is(after, "mspace");
    if (opens(spaced ? after.nextSibling : after) && (spaced || FUNCTION.test(text(leaf(child)))))
      node.insertBefore(element(node, "mo", spaced ? INVISIBLE_TIMES : APPLY), after);
  }
}

function isVector(node) {
  if (!node || /[⋅∙|]/.test(text(node))) return false;
  return BOLD.test(text(node)) || has(node, "mtable") || (opens(node) && text(node).includes(","));
}

/** Two bars stand around a value, or a vector's norm; one in parentheses is a condition. */
function bars(node) {
  if (!is(node, ROWS)) return;
  const found = children(node).filter((child) => is(child, "mo", /^[|∣]$/));
  if (found.length === 1) found[0].textContent = wordOfBar(text(node));
  if (found.length % 2) return;
  for (let place = 0; place < found.length; place += 2) {
    const inside = between(found[place], found[place + 1]);
    const words = inside.map(text).join("");
    const sign = BOLD.test(words) && !words.includes(DOT) ? "‖" : "|";
    const fences = [element(node, "mo", sign), element(node, "mo", sign)];
    for (const fence of fences) fence.setAttribute("fence", "true");
    node.removeChild(found[place + 1]);
    swap(found[place], element(node, "mrow", fences[0], ...inside, fences[1]));
  }
}

function wordOfBar(row) {
  if (row.startsWith("{")) return "such that";
  return row.startsWith("[") && BOLD.test(row) ? "augmented by" : "given";
}

/** Lines without the empty cells that align them; a single one is a row. */
function lines(node) {
  if (!is(node, "mtable") || !/jot/.test(node.getAttribute("class"))) return;
  const found = children(node);
  for (const line of found)
    for (const cell of children(line)) if (!text(cell)) line.removeChild(cell);
  if (found.length === 1)
    swap(node, element(node, "mrow", ...children(found[0]).flatMap(children)));
}

/** Without the full stop or comma of the sentence around a formula, or behind a line of it. */
function ending(node) {
  if (!is(node, "math|mtr")) return;
  let last = node;
  while (children(last).length) last = children(last).at(-1);
  if (is(last, "mo", /^[.,]$/)) last.parentNode.removeChild(last);
  else if (is(last, "mtext|mn")) last.textContent = text(last).replace(/[.,]$/, "");
}

function between(first, last) {
  const found = [];
  for (let node = first.nextSibling; node !== last; node = node.nextSibling) found.push(node);
  return found;
}

function leaf(node) {
  const [first] = children(node);
  return first ? leaf(first) : node;
}

const children = (node) => Array.from(node.childNodes).filter((child) => child.nodeType === 1);
const text = (node) => node.textContent.replace(/[\s\u2061]+/g, " ").trim();
const has = (node, name) => node.localName === name || node.getElementsByTagName(name).length > 0;
const opens = (node) => is(node, "mrow|mo|msup|msub|msubsup", /^[([]/);
const swap = (node, other) => node.parentNode.replaceChild(other, node);

/** Whether it is one of some elements, and has such a text. */
function is(node, names, pattern = /(?:)/) {
  return Boolean(node) && names.split("|").includes(node.localName) && pattern.test(text(node));
}

function element(near, name, ...content) {
  const made = near.ownerDocument.createElementNS(MATHML, name);
  for (const one of content)
    made.appendChild(typeof one === "string" ? near.ownerDocument.createTextNode(one) : one);
  return made;
}
