/** Elements that must be there, with the type that they must have; and new ones; files for the reader. */

/** The first descendant of `root` that fits; an error where there is none, or of another type. */
export function find<T extends Element>(root: ParentNode, selector: string, type: new () => T): T {
  const found = findOptional(root, selector, type);
  if (!found) throw new Error(`the page has no ${selector}`);
  return found;
}

/** The first descendant of `root` that fits, or null; an error where it is of another type. */
export function findOptional<T extends Element>(
  root: ParentNode,
  selector: string,
  type: new () => T,
): T | null {
  const found = root.querySelector(selector);
  if (!found) return null;
  if (!(found instanceof type)) throw new Error(`${selector} is no ${type.name}`);
  return found;
}

/** All descendants of `root` that fit and are of the type. */
export function findAll<T extends Element>(
  root: ParentNode,
  selector: string,
  type: new () => T,
): T[] {
  const found = [...root.querySelectorAll(selector)];
  return found.flatMap((element) => (element instanceof type ? [element] : []));
}

/** The element in which an event happened that fits, or null. */
export function closestTo<T extends Element>(
  event: Event,
  selector: string,
  type: new () => T,
): T | null {
  const found = event.target instanceof Element ? event.target.closest(selector) : null;
  return found instanceof type ? found : null;
}

/** The element that the address, or a link, points to; none where its end is mangled. */
export function hashTarget(hash: string = location.hash) {
  try {
    return document.getElementById(decodeURIComponent(hash.slice(1)));
  } catch {
    return null;
  }
}

/** Open the folds around an element, if there are any. */
export function unfold(found: Element | null) {
  for (let fold = enclosingFold(found); fold; fold = enclosingFold(fold)) fold.open = true;
}

function enclosingFold(found: Element | null) {
  return found?.parentElement?.closest("details") ?? null;
}

/** A new element with a class and a text. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  className: string = "",
  text: string = "",
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text) made.textContent = text;
  return made;
}

/** Whether a click on a link follows it in this window. */
export function isPlainClick(event: MouseEvent) {
  const { button, metaKey, ctrlKey, shiftKey, altKey } = event;
  return button === 0 && !(metaKey || ctrlKey || shiftKey || altKey);
}

/** The content of a `<script type="application/json">` of the page. */
export function data(root: ParentNode, selector: string): any {
  return JSON.parse(find(root, selector, HTMLScriptElement).text);
}

/** Hand the reader a file. */
export function download(name: string, content: BlobPart, type: string = "") {
  const link = element("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Beginnings that programs for tables take for a formula, also behind spaces and full-width. */
const FORMULA = /^(?:[\t\r]|\s*[=+\-@＝＋－＠])/;

/** Comma-separated values (RFC 4180), in which no text is a formula; numbers stay numbers. */
export function csv(rows: (string | number)[][]) {
  const field = (value: string | number) => {
    const given = String(value);
    const text = FORMULA.test(given) && !Number.isFinite(Number(given)) ? `'${given}` : given;
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return rows.map((row) => `${row.map(field).join(",")}\r\n`).join("");
}
