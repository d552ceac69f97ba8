/**
 * Drawings over pictures, changed and not rebuilt. A scene draws the same things in the same order
 * in most frames, so what is there already stays and takes the new places and words: only elements
 * that differ are styled, laid out and painted anew.
 */

/**
 * Where markup is parsed: an `svg`, so that its children are read as those of an overlay, in a document
 * that loads nothing.
 */
const scratch = document.implementation
  .createHTMLDocument()
  .createElementNS("http://www.w3.org/2000/svg", "svg");

/**
 * What a drawing by a reader's Python may not hold: what leads or reaches elsewhere, styles of the whole
 * page, and copies, of which a few that hold each other are too many to draw.
 */
const ACTIVE =
  "script, style, use, foreignObject, a, set, animate, animateMotion, animateTransform";
/** Paint made of shapes: where it is made of such paint itself, a few letters are too much to draw. */
const PAINT = "pattern, mask, clipPath, marker";
const REACHING = `${ACTIVE}, [*|href]:not([*|href^="#"], [*|href^="data:image/"])`;

/** A panel's drawing. */
export class Overlay {
  #shown: string | null = null;

  constructor(readonly svg: Element) {}

  /** Show what `markup` says, as if it had been parsed into the place. */
  show(markup: string) {
    if (markup === this.#shown) return;
    scratch.innerHTML = markup;
    removeActive(scratch, markup);
    changeChildren(this.svg, scratch);
    scratch.replaceChildren();
    this.#shown = markup;
  }
}

/** Leave shapes, text and paint. */
function removeActive(drawing: Element, markup: string) {
  const mayHandle = /\bon\w/i.test(markup);
  for (const element of drawing.querySelectorAll("*")) {
    const nested = element.matches(PAINT) && element.outerHTML.includes("url(");
    if (nested || element.namespaceURI !== drawing.namespaceURI || element.matches(REACHING)) {
      element.remove();
    } else if (mayHandle) {
      for (const name of element.getAttributeNames()) {
        if (/^on/i.test(name)) element.removeAttribute(name);
      }
    }
  }
}

/**
 * Make the children of `parent` equal those of `wanted`, which may lose its own. Where there are
 * more or fewer than before, what is equal at both ends is none of the news.
 */
function changeChildren(parent: Element, wanted: Element) {
  const [old, fresh] = [[...parent.childNodes], [...wanted.childNodes]];
  let [begin, oldEnd, freshEnd] = [0, old.length, fresh.length];
  if (oldEnd !== freshEnd) {
    const shorter = Math.min(oldEnd, freshEnd);
    while (begin < shorter && old[begin].isEqualNode(fresh[begin])) begin += 1;
    while (begin < Math.min(oldEnd, freshEnd) && old[oldEnd - 1].isEqualNode(fresh[freshEnd - 1])) {
      oldEnd -= 1;
      freshEnd -= 1;
    }
  }
  const after = old[oldEnd] ?? null;
  const both = Math.min(oldEnd, freshEnd);
  for (let index = begin; index < both; index += 1) changeNode(old[index], fresh[index]);
  for (const node of old.slice(both, oldEnd)) node.remove();
  for (const node of fresh.slice(both, freshEnd)) parent.insertBefore(node, after);
}

function changeNode(old: ChildNode, fresh: ChildNode) {
  if (old instanceof Element && fresh instanceof Element && isSameKind(old, fresh)) {
    changeAttributes(old, fresh);
    changeChildren(old, fresh);
  } else if (old instanceof Text && fresh instanceof Text) {
    if (old.data !== fresh.data) old.data = fresh.data;
  } else {
    old.replaceWith(fresh);
  }
}

function isSameKind(one: Element, other: Element) {
  return one.localName === other.localName && one.namespaceURI === other.namespaceURI;
}

function changeAttributes(old: Element, fresh: Element) {
  for (const { namespaceURI, localName, name, value } of fresh.attributes) {
    if (old.getAttributeNS(namespaceURI, localName) !== value) {
      old.setAttributeNS(namespaceURI, name, value);
    }
  }
  if (old.attributes.length === fresh.attributes.length) return;
  for (const { namespaceURI, localName } of [...old.attributes]) {
    if (!fresh.hasAttributeNS(namespaceURI, localName)) {
      old.removeAttributeNS(namespaceURI, localName);
    }
  }
}
