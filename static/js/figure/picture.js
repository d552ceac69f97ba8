/**
 * A panel as a file: a drawing as SVG, a picture with its drawing as PNG. Both stand alone, with the
 * colours of the theme that the reader sees and the letters of the page in them.
 */

import { all, maybe, one } from "../page/dom.js";
import { words } from "../page/words.js";

/** Pixels of the file for each pixel of the page. */
const SCALE = 2;
/** Of these, what no element takes from the one around it. */
const OWN = ["opacity", "vector-effect"];
/** What a style sheet says of a drawing, and a file must say itself. */
const PROPERTIES = [
  ...OWN,
  "color",
  "fill",
  "fill-opacity",
  "font-family",
  "font-size",
  "font-style",
  "font-variant-numeric",
  "font-weight",
  "paint-order",
  "stroke",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "stroke-width",
  "text-anchor",
];

/**
 * @param {HTMLElement} panel
 * @returns {Promise<{blob: Blob, suffix: "svg" | "png"}>}
 */
export async function pictureOf(panel) {
  const view = one(panel, ".panel-view", HTMLElement);
  const pixels = maybe(view, "canvas, img", HTMLElement);
  const drawing = await standalone(one(view, "svg.overlay", SVGSVGElement), view);
  if (!pixels) {
    const ground = document.createElementNS(drawing.namespaceURI, "rect");
    ground.setAttribute("width", "100%");
    ground.setAttribute("height", "100%");
    ground.setAttribute("fill", getComputedStyle(view).backgroundColor);
    drawing.prepend(ground);
    return { blob: fileOf(drawing), suffix: "svg" };
  }
  return { blob: await flattened(view, pixels, drawing), suffix: "png" };
}

/**
 * A copy of a drawing that needs no style sheet and no font of the page.
 *
 * @param {SVGSVGElement} svg
 * @param {HTMLElement} view
 */
async function standalone(svg, view) {
  const copy = /** @type {SVGSVGElement} */ (svg.cloneNode(true));
  const originals = [svg, ...svg.querySelectorAll("*")];
  const copies = [copy, ...copy.querySelectorAll("*")];
  for (const [index, original] of originals.entries()) {
    copies[index].setAttribute("style", styleOf(original, original !== svg));
    copies[index].removeAttribute("class");
  }
  copy.style.filter = getComputedStyle(svg).filter;
  copy.setAttribute("width", String(view.clientWidth));
  copy.setAttribute("height", String(view.clientHeight));
  copy.removeAttribute("aria-hidden");
  const style = document.createElementNS(copy.namespaceURI, "style");
  style.textContent = await fontsOf(svg);
  copy.prepend(style);
  return copy;
}

/**
 * What the style sheets say of an element, as its own style.
 *
 * @param {Element} element
 * @param {boolean} inherits Whether to leave out what it has from the element around it.
 */
function styleOf(element, inherits) {
  const [styles, around] = [element, element.parentElement ?? element].map((one) =>
    getComputedStyle(one),
  );
  return PROPERTIES.filter(
    (name) =>
      !inherits ||
      OWN.includes(name) ||
      styles.getPropertyValue(name) !== around.getPropertyValue(name),
  )
    .map((name) => `${name}:${styles.getPropertyValue(name)}`)
    .join(";");
}

/**
 * The faces that the words of a drawing may be set in, each with its letters in it.
 *
 * @param {SVGSVGElement} svg
 * @returns {Promise<string>}
 */
async function fontsOf(svg) {
  const words = all(svg, "text, tspan", SVGElement).map((text) => getComputedStyle(text));
  const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]);
  const faces = rules
    .filter((rule) => rule instanceof CSSFontFaceRule)
    .filter(({ style }) =>
      words.some(
        (word) =>
          word.fontFamily.includes(style.getPropertyValue("font-family")) &&
          word.fontStyle === (style.getPropertyValue("font-style") || "normal") &&
          style.getPropertyValue("font-weight").split(" ").includes(word.fontWeight),
      ),
    );
  return (await Promise.all(faces.map(embedded))).join("\n");
}

/** @param {CSSFontFaceRule} rule */
async function embedded({ cssText, parentStyleSheet }) {
  const address = /url\("?([^")]+)"?\)/.exec(cssText);
  if (!address) return cssText;
  const font = await fetch(new URL(address[1], parentStyleSheet?.href ?? location.href));
  return cssText.replace(address[0], `url("${await dataUrl(await font.blob())}")`);
}

/**
 * @param {Blob} blob
 * @returns {Promise<string>}
 */
function dataUrl(blob) {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}

/** @param {SVGSVGElement} drawing */
function fileOf(drawing) {
  const text = new XMLSerializer().serializeToString(drawing);
  return new Blob([text], { type: "image/svg+xml" });
}

/**
 * Pixels and drawing as one picture.
 *
 * @param {HTMLElement} view
 * @param {HTMLElement} pixels
 * @param {SVGSVGElement} drawing
 * @returns {Promise<Blob>}
 */
async function flattened(view, pixels, drawing) {
  const canvas = document.createElement("canvas");
  canvas.width = SCALE * view.clientWidth;
  canvas.height = SCALE * view.clientHeight;
  const context = canvas.getContext("2d");
  if (!context) throw new Error(words("tools.no_canvas"));
  context.fillStyle = getComputedStyle(view).backgroundColor;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingEnabled = !pixels.classList.contains("pixelated");
  const ink = new Image();
  ink.src = await dataUrl(fileOf(drawing));
  await ink.decode();
  for (const layer of [pixels, ink]) {
    context.drawImage(/** @type {CanvasImageSource} */ (layer), 0, 0, canvas.width, canvas.height);
  }
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error(words("tools.no_picture")))));
  });
}
