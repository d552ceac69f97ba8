/**
 * A panel as a file: a drawing as SVG, a picture with its drawing as PNG. Both stand alone, with the
 * colours of the theme that the reader sees and the fonts of the page in them.
 */

import { findAll, findOptional, find } from "../page/dom.ts";
import { words } from "../page/words.ts";

/** Pixels of the file for each pixel of the page. */
const SCALE = 2;
/** Properties that the page's style sheets set and a file must hold itself. */
const PROPERTIES = [
  "color",
  "fill",
  "fill-opacity",
  "font-family",
  "font-size",
  "font-style",
  "font-variant-numeric",
  "font-weight",
  "opacity",
  "paint-order",
  "stroke",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "stroke-width",
  "text-anchor",
  "vector-effect",
];

export async function panelFile(
  panel: HTMLElement,
): Promise<{ blob: Blob; suffix: "svg" | "png" }> {
  const view = find(panel, ".panel-view", HTMLElement);
  const pixels = findOptional(view, "canvas, img", HTMLElement);
  const drawing = await standalone(find(view, "svg.overlay", SVGSVGElement), view);
  if (pixels) return { blob: await mergedPicture(view, pixels, drawing), suffix: "png" };
  const ground = document.createElementNS(drawing.namespaceURI, "rect");
  ground.setAttribute("width", "100%");
  ground.setAttribute("height", "100%");
  ground.setAttribute("fill", getComputedStyle(view).backgroundColor);
  drawing.prepend(ground);
  return { blob: fileOf(drawing), suffix: "svg" };
}

/** A copy of a drawing that needs no style sheet and no font of the page. */
async function standalone(svg: SVGSVGElement, view: HTMLElement) {
  const copy = svg.cloneNode(true) as SVGSVGElement;
  const copies = [copy, ...copy.querySelectorAll("*")];
  for (const [index, original] of [svg, ...svg.querySelectorAll("*")].entries()) {
    const styles = getComputedStyle(original);
    const styling = PROPERTIES.map((name) => `${name}:${styles.getPropertyValue(name)}`);
    copies[index].setAttribute("style", styling.join(";"));
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

/** The font faces of a drawing's texts, each with its outlines in it. */
async function fontsOf(svg: SVGSVGElement): Promise<string> {
  const texts = findAll(svg, "text, tspan", SVGElement).map((text) => getComputedStyle(text));
  const faces = [...document.styleSheets]
    .flatMap((sheet) => [...sheet.cssRules])
    .filter((rule) => rule instanceof CSSFontFaceRule)
    .filter(({ style }) =>
      texts.some(
        (text) =>
          text.fontFamily.includes(style.getPropertyValue("font-family")) &&
          text.fontStyle === (style.getPropertyValue("font-style") || "normal") &&
          style.getPropertyValue("font-weight").split(" ").includes(text.fontWeight),
      ),
    );
  return (await Promise.all(faces.map(withEmbeddedFont))).join("\n");
}

async function withEmbeddedFont({ cssText, parentStyleSheet }: CSSFontFaceRule) {
  const address = /url\("?([^")]+)"?\)/.exec(cssText);
  if (!address) return cssText;
  const font = await fetch(new URL(address[1], parentStyleSheet?.href ?? location.href));
  return cssText.replace(address[0], `url("${await dataUrl(await font.blob())}")`);
}

function dataUrl(blob: Blob): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });
}

function fileOf(drawing: SVGSVGElement) {
  const text = new XMLSerializer().serializeToString(drawing);
  return new Blob([text], { type: "image/svg+xml" });
}

/** Pixels and drawing as one picture. */
async function mergedPicture(view: HTMLElement, pixels: HTMLElement, drawing: SVGSVGElement) {
  const canvas = new OffscreenCanvas(SCALE * view.clientWidth, SCALE * view.clientHeight);
  const context = canvas.getContext("2d");
  if (!context) throw new Error(words("tools.no_canvas"));
  context.fillStyle = getComputedStyle(view).backgroundColor;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.imageSmoothingEnabled = !pixels.classList.contains("pixelated");
  const ink = new Image();
  ink.src = await dataUrl(fileOf(drawing));
  await ink.decode();
  for (const layer of [pixels, ink]) {
    context.drawImage(layer as CanvasImageSource, 0, 0, canvas.width, canvas.height);
  }
  return canvas.convertToBlob();
}
