/**
 * Points measured on the reader's device in the chart of a ladder. The builder draws the rest and gives the axes:
 * `position` is `ChartAxis.position` in `site_builder/benchmarks/charts.py`.
 */

type Scale = { low: number; high: number; start: number; end: number; log: boolean };

type Axis = { scale: Scale; none: number | null };

type Metric = { id: string; label: string; unit: string; higher: boolean };

export interface Result {
  tier: string;
  milliseconds: number;
  low_ms: number;
  high_ms: number;
  repeats: number;
  errors: Record<string, number | null>;
}

export interface Ladder {
  ladder: string;
  metrics: Metric[];
  tiers: { id: string; label: string }[];
  time: Axis;
  error: Axis;
}

const SVG = "http://www.w3.org/2000/svg";
const HALF = 5.5;
/** Corners of a diamond; of arrows that point off the chart, to its start and to its end. */
const DIAMOND = `0,${-HALF} ${HALF},0 0,${HALF} ${-HALF},0`;
const ARROWS = [-HALF, HALF].map((tip) => `${tip},0 ${-tip},${HALF} ${-tip},${-HALF}`);

/**
 * A diamond or a ring at the median, on a bar over the middle half of the samples. Where the chart ends
 * before the value does, an arrow at its border.
 */
export function addPoint(
  group: Element,
  result: Result,
  { time, error, metrics }: Ladder,
  form: "diamond" | "ring" = "diamond",
) {
  const [metric] = metrics;
  const y = position(error, result.errors[metric.id] ?? (metric.higher ? Infinity : 0));
  const [low, x, high] = [result.low_ms, result.milliseconds, result.high_ms].map((value) =>
    position(time, value),
  );
  const { scale } = time;
  const beyond = result.milliseconds > scale.high ? ARROWS[1] : DIAMOND;
  const points = result.milliseconds < scale.low ? ARROWS[0] : beyond;
  const transform = `translate(${x.toFixed(2)} ${y.toFixed(2)})`;
  group.append(
    element("line", { class: "spread", x1: low, x2: high, y1: y, y2: y }),
    form === "ring" && points === DIAMOND
      ? element("circle", { class: "ring", r: HALF + 2, transform })
      : element("polygon", { class: "solid", points, transform }),
  );
}

export function position({ scale, none }: Axis, value: number) {
  const isNone = scale.log ? value <= 0 : !Number.isFinite(value);
  if (isNone && none !== null) return none;
  const inside = Math.min(Math.max(value, scale.low), scale.high);
  const [at, low, high] = [inside, scale.low, scale.high].map((end) =>
    scale.log ? Math.log10(end) : end,
  );
  return scale.start + ((at - low) / (high - low)) * (scale.end - scale.start);
}

function element(name: string, attributes: Record<string, string | number>) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}
