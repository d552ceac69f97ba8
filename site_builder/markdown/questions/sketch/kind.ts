/**
 * A curve that the reader sketches: drawn in its field by pointer or touch, or point by point with
 * the sliders that lie over it, which arrow keys move.
 */

import { findAll, find, closestTo } from "../../../../static/js/page/dom.ts";
import { numeral, words } from "../../../../static/js/page/words.ts";
import { type Kind, type Question, questionOf } from "../../../../static/js/question/question.ts";

interface Sketch {
  field: Record<"left" | "right" | "top" | "bottom", number>;
  x: [number, number];
  y: [number, number];
  truth: number[];
}

interface Sketched extends Question {
  sketch: Sketch;
}

const SVG = "http://www.w3.org/2000/svg";
const RADIUS = 5;
/** How near to a point, along the axis, a stroke takes it along without passing it. */
const NEAR = 8;
/** How far, of the height of its axis, a sketched curve may be off and pass for the true one. */
const CLOSE = 0.1;

export const kind: Kind<Sketched, number[]> = {
  install() {
    document.addEventListener("pointerdown", (event) => {
      const svg = closestTo(event, ".sketch > svg", SVGSVGElement);
      const form = svg?.closest("form");
      if (!svg || !form || event.button !== 0 || form.dataset.answered) return;
      event.preventDefault();
      draw(svg, form, event);
    });
    document.addEventListener("input", (event) => {
      const form = closestTo(event, ".sketch-points input", Element)?.closest("form");
      if (!form) return;
      closestTo(event, "input", HTMLInputElement)?.classList.add("set");
      redraw(form);
    });
    for (const name of ["focusin", "focusout"]) {
      document.addEventListener(name, (event) => {
        const form = closestTo(event, ".sketch-points input", Element)?.closest("form");
        if (form) markFocus(form);
      });
    }
  },

  /** Begin with points in the middle, which are no guess yet. */
  prepare(form, { sketch }) {
    delete form.dataset.drawn;
    const points = sliders(form).map((slider, index) => {
      slider.classList.remove("set");
      const circle = document.createElementNS(SVG, "circle");
      circle.setAttribute("r", String(RADIUS));
      circle.setAttribute("cx", String(across(index, sketch)));
      return circle;
    });
    find(form, ".points", SVGGElement).replaceChildren(...points);
    place(form, sketch);
  },

  read(form) {
    return "drawn" in form.dataset ? sliders(form).map((slider) => slider.valueAsNumber) : null;
  },

  missing: () => words("predict.sketch"),

  fits({ sketch: { truth } }, given) {
    return Array.isArray(given) && given.length === truth.length && given.every(Number.isFinite);
  },

  put(form, given) {
    for (const [index, slider] of sliders(form).entries()) {
      slider.value = String(given[index]);
      slider.classList.add("set");
    }
    redraw(form);
  },

  /** Judge by the place where the curves are farthest apart. */
  judge({ sketch: { x, y, truth } }, given) {
    const off = truth.map((value, index) => Math.abs(value - given[index]));
    const farthest = Math.max(...off);
    const index = off.indexOf(farthest);
    const along = x[0] + ((x[1] - x[0]) * index) / (truth.length - 1);
    const numbers = {
      x: short(along, x),
      drawn: short(given[index], y),
      truth: short(truth[index], y),
    };
    const remark = words("predict.farthest", numbers);
    return { right: farthest <= CLOSE * (y[1] - y[0]), replies: [], remark };
  },
};

/** Round to a thousandth of its axis, or finer, with a true minus sign. */
function short(value: number, [start, end]: [number, number]) {
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(end - start)));
  return numeral(String(Number(value.toFixed(decimals))).replace("-", "\u2212"));
}

/** Each point that the pointer passes goes to its height. */
function draw(svg: SVGSVGElement, form: HTMLFormElement, event: PointerEvent) {
  const sketch = sketchOf(form);
  const done = new AbortController();
  const { signal } = done;
  let last = placeOf(svg, event);
  const stroke = (moved: PointerEvent) => {
    const now = placeOf(svg, moved);
    pull(form, sketch, last, now);
    last = now;
  };
  svg.setPointerCapture(event.pointerId);
  svg.addEventListener("pointermove", stroke, { signal });
  for (const end of ["pointerup", "pointercancel"]) {
    svg.addEventListener(end, () => done.abort(), { signal });
  }
  stroke(event);
}

/** Points that no stroke has passed yet follow the nearest one that has been. */
function pull(form: HTMLFormElement, sketch: Sketch, from: DOMPoint, to: DOMPoint) {
  const { top, bottom } = sketch.field;
  const [low, high] = [Math.min(from.x, to.x), Math.max(from.x, to.x)];
  const reach = low < high ? NEAR : (across(1, sketch) - across(0, sketch)) / 2;
  const points = sliders(form);
  for (const [index, slider] of points.entries()) {
    const x = across(index, sketch);
    const passed = x >= low && x <= high;
    if (!passed && Math.abs(x - to.x) > reach) continue;
    const share = passed && high > low ? (x - from.x) / (to.x - from.x) : 1;
    const y = from.y + share * (to.y - from.y);
    const [least, most] = sketch.y;
    slider.value = String(least + ((most - least) * (bottom - y)) / (bottom - top));
    slider.classList.add("set");
  }
  const set = points.flatMap((slider, index) => (slider.matches(".set") ? [index] : []));
  for (const [index, slider] of points.entries()) {
    const [nearest] = set.toSorted((a, b) => Math.abs(a - index) - Math.abs(b - index));
    if (nearest !== undefined) slider.value = points[nearest].value;
  }
  redraw(form);
}

function redraw(form: HTMLFormElement) {
  form.dataset.drawn = "";
  place(form, sketchOf(form));
}

function place(form: HTMLFormElement, sketch: Sketch) {
  const { top, bottom } = sketch.field;
  const [least, most] = sketch.y;
  const circles = findAll(form, ".points circle", SVGCircleElement);
  const corners = sliders(form).map((slider, index) => {
    const y = bottom + ((top - bottom) * (slider.valueAsNumber - least)) / (most - least);
    circles[index]?.setAttribute("cy", y.toFixed(1));
    return `${across(index, sketch).toFixed(1)} ${y.toFixed(1)}`;
  });
  find(form, ".drawn", SVGPathElement).setAttribute("d", `M${corners.join("L")}`);
}

function markFocus(form: HTMLFormElement) {
  const circles = findAll(form, ".points circle", SVGCircleElement);
  for (const [index, slider] of sliders(form).entries()) {
    circles[index]?.classList.toggle("focused", slider === document.activeElement);
  }
}

function across(index: number, { field, truth }: Sketch) {
  return field.left + ((field.right - field.left) * index) / (truth.length - 1);
}

/** Where the pointer is, in the drawing's units. */
function placeOf(svg: SVGSVGElement, { clientX, clientY }: PointerEvent) {
  return new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM()?.inverse());
}

function sketchOf(form: HTMLFormElement) {
  return (questionOf(form) as Sketched).sketch;
}

function sliders(form: HTMLFormElement) {
  return findAll(form, ".sketch-points input", HTMLInputElement);
}
