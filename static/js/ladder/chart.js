/**
 * The reader's own points in the chart of a ladder. The axes come from the builder, which drew
 * the rest: `position` is `ChartAxis.position` of the builder's axes.py.
 *
 * @typedef {{low: number, high: number, start: number, end: number, log: boolean}} Scale
 * @typedef {{scale: Scale, none: number | null}} Axis
 */

const SVG = "http://www.w3.org/2000/svg";
const HALF = 5.5;

/** @import { Ladder, Result } from "./bench.js" */

/**
 * A diamond at the median, on a bar over the middle half of the samples. Where the chart ends
 * before the value does, an arrow at its border.
 *
 * @param {Element} group
 * @param {Result} result
 * @param {Ladder} ladder
 */
export function addPoint(group, result, { time, error, metrics }) {
  const [metric] = metrics;
  const y = position(error, result.errors[metric.id] ?? (metric.higher ? Infinity : 0));
  const [low, x, high] = [result.low_ms, result.milliseconds, result.high_ms].map((value) =>
    position(time, value),
  );
  group.append(
    element("line", { class: "spread", x1: low, x2: high, y1: y, y2: y }),
    element("polygon", { class: "solid", points: marker(x, y, sideOf(time, result.milliseconds)) }),
  );
}

/**
 * @param {Axis} axis
 * @param {number} value
 */
export function position({ scale, none }, value) {
  const isNone = scale.log ? value <= 0 : !Number.isFinite(value);
  if (isNone && none !== null) return none;
  const inside = Math.min(Math.max(value, scale.low), scale.high);
  const [at, low, high] = [inside, scale.low, scale.high].map((end) =>
    scale.log ? Math.log10(end) : end,
  );
  return scale.start + ((at - low) / (high - low)) * (scale.end - scale.start);
}

/**
 * −1 or 1 where the value lies before or beyond the axis.
 *
 * @param {Axis} axis
 * @param {number} value
 */
function sideOf({ scale }, value) {
  return value < scale.low ? -1 : value > scale.high ? 1 : 0;
}

/**
 * Corners of a diamond, or of an arrow that points off the chart.
 *
 * @param {number} x
 * @param {number} y
 * @param {number} side
 */
function marker(x, y, side) {
  const corners = side
    ? [
        [side * HALF, 0],
        [-side * HALF, HALF],
        [-side * HALF, -HALF],
      ]
    : [
        [0, -HALF],
        [HALF, 0],
        [0, HALF],
        [-HALF, 0],
      ];
  return corners.map(([dx, dy]) => `${(x + dx).toFixed(2)},${(y + dy).toFixed(2)}`).join(" ");
}

/**
 * @param {string} name
 * @param {Record<string, string | number>} attributes
 */
function element(name, attributes) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}
