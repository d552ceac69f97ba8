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
 * Elements and attributes of drawings: those that scenes draw (`simulations/engine/drafting.py`). None
 * refers to another element, to an address or to a style sheet, so that a drawing by a reader's Python
 * sends no request and takes no longer to paint than its elements do.
 */
const ELEMENTS = new Set(
  "g path line polyline polygon rect circle ellipse text tspan image".split(" "),
);
const ATTRIBUTES = new Set(
  `class color fill fill-opacity stroke stroke-opacity stroke-width opacity transform d points x y x1 y1
  x2 y2 cx cy r rx ry width height dx dy text-anchor preserveAspectRatio href data-estimate`.split(
    /\s+/,
  ),
);
/** In a value: an escape of CSS, or a function that is neither a transformation nor a colour. */
const FORBIDDEN = /\\|(?<!\b(?:translate|rotate|scale|skewX|skewY|matrix|rgba?|hsla?))\(/i;
const RASTER = /^data:image\/(?:png|jpeg|webp|gif)[;,]/;
/** Scenes draw some hundreds. */
const MOST_ELEMENTS = 20_000;

/** A panel's drawing. */
export class Overlay {
  #shown: string | null = null;

  constructor(readonly svg: Element) {}

  /** Show the drawing of `markup`. */
  show(markup: string) {
    if (markup === this.#shown) return;
    scratch.innerHTML = markup;
    removeForbidden(scratch);
    changeChildren(this.svg, scratch);
    scratch.replaceChildren();
    this.#shown = markup;
  }
}

/** Leave the elements, attributes and values that a drawing may have. */
function removeForbidden(drawing: Element) {
  let count = 0;
  for (const element of drawing.querySelectorAll("*")) {
    const isDrawn =
      ELEMENTS.has(element.localName) && element.namespaceURI === drawing.namespaceURI;
    if (!isDrawn || ++count > MOST_ELEMENTS) {
      element.remove();
      continue;
    }
    for (const { name, value } of [...element.attributes]) {
      const isValid = name === "href" ? RASTER.test(value) : !FORBIDDEN.test(value);
      if (!ATTRIBUTES.has(name) || !isValid) element.removeAttribute(name);
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
