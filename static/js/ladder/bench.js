/**
 * `<ladder-bench>`: measures a ladder's tiers on the reader's device, one after another, in the
 * worker that also draws the figures. Chart and table are in the page already; what is measured
 * here is added to them.
 *
 * States, in `data-state`: `idle`, `running`, `done`, `stopped`, `failed`. A stop takes effect
 * when the tier at hand is finished.
 */

import { message } from "../errors.js";
import { all, data, one } from "../page/dom.js";
import { Runtime, sharedRuntime } from "../runtime/runtime.js";
import { addPoint } from "./chart.js";
import { numeral, words } from "../page/words.js";

/** @import { Axis } from "./chart.js" */

/** Figures that the reader waits for go first. */
const URGENCY = -1;
/** Seconds spent on the samples of one tier. */
const BUDGET = 0.4;

/**
 * @typedef {{id: string, label: string, unit: string, higher: boolean}} Metric
 * @typedef {{tier: string, milliseconds: number, low_ms: number, high_ms: number,
 *   repeats: number, errors: Record<string, number | null>}} Result
 * @typedef {{ladder: string, metrics: Metric[], tiers: {id: string, label: string}[],
 *   time: Axis, error: Axis}} Ladder
 */

/** Called once. */
export function install() {
  customElements.define("ladder-bench", LadderBench);
}

class LadderBench extends HTMLElement {
  /** @type {AbortController | null} */
  #listeners = null;
  #stopped = false;
  #csv = "";

  connectedCallback() {
    const runtime = sharedRuntime();
    if (!runtime || !Runtime.supported) {
      this.dataset.unavailable = "";
      return;
    }
    this.#listeners = new AbortController();
    const { signal } = this.#listeners;
    this.#button("run").addEventListener("click", () => this.#run(runtime), { signal });
    this.#button("stop").addEventListener("click", () => this.#stop(), { signal });
  }

  /** @returns {Ladder} */
  get ladder() {
    return data(this, "script.ladder-data");
  }

  disconnectedCallback() {
    this.#stopped = true;
    this.#listeners?.abort();
    URL.revokeObjectURL(this.#csv);
  }

  /** @param {Runtime} runtime */
  async #run(runtime) {
    if (this.dataset.state === "running") return;
    this.#begin();
    /** @type {Result[]} */
    const results = [];
    try {
      for (const tier of this.ladder.tiers) {
        if (this.#stopped) break;
        this.#say(words("ladder.measuring", { tier: tier.label }));
        results.push(await this.#measure(runtime, tier.id));
        if (!this.isConnected) return;
        this.#show(results);
      }
      this.#end(this.#stopped ? "stopped" : "done", this.#summary(results));
    } catch (error) {
      this.#end("failed", words("ladder.broke_off", { reason: message(error) }));
    }
  }

  /**
   * @param {Runtime} runtime
   * @param {string} tier
   * @returns {Promise<Result>}
   */
  async #measure(runtime, tier) {
    const payload = { ladder: this.ladder.ladder, tier, budget: BUDGET };
    const reply = await runtime.call("measure", payload, () => URGENCY);
    return JSON.parse(reply.result);
  }

  #begin() {
    this.#stopped = false;
    this.dataset.state = "running";
    this.#enable("stop", "run");
    this.#points.replaceChildren();
    for (const cell of all(this, "td.own", HTMLElement)) cell.textContent = "–";
    this.#progress(0);
  }

  #stop() {
    this.#stopped = true;
    this.#say(words("ladder.stopping"));
  }

  /**
   * @param {string} state
   * @param {string} text
   */
  #end(state, text) {
    this.dataset.state = state;
    this.#enable("run", "stop");
    this.#say(text);
  }

  /**
   * One of the two buttons in place of the other; who stood on that one is led over.
   *
   * @param {string} name
   * @param {string} other
   */
  #enable(name, other) {
    const [button, left] = [this.#button(name), this.#button(other)];
    button.disabled = false;
    if (document.activeElement === left) button.focus({ preventScroll: true });
    left.disabled = true;
  }

  /**
   * Chart, table, progress and file, after the newest of `results`.
   *
   * @param {Result[]} results Not empty.
   */
  #show(results) {
    const result = results[results.length - 1];
    this.dataset.measured = String(results.length);
    addPoint(this.#points, result, this.ladder);
    const cell = one(this, `tr[data-tier="${CSS.escape(result.tier)}"] td.own`, HTMLElement);
    cell.textContent = numeral(milliseconds(result.milliseconds));
    this.#progress(results.length);
    this.#offer(results);
  }

  /** @param {Result[]} results */
  #summary(results) {
    return words("ladder.measured", { count: results.length, all: this.ladder.tiers.length });
  }

  /**
   * A link to the numbers as a file.
   *
   * @param {Result[]} results
   */
  #offer(results) {
    URL.revokeObjectURL(this.#csv);
    this.#csv = URL.createObjectURL(new Blob([toCsv(results, this.ladder)], { type: "text/csv" }));
    const link = one(this, "a.download", HTMLAnchorElement);
    link.href = this.#csv;
    link.download = `${this.ladder.ladder}.csv`;
    link.removeAttribute("aria-disabled");
  }

  /** @param {number} count */
  #progress(count) {
    one(this, "progress", HTMLProgressElement).value = count;
  }

  /** @param {string} text */
  #say(text) {
    one(this, ".ladder-status", HTMLElement).textContent = text;
  }

  /** The group of the chart that holds the reader's own points. */
  get #points() {
    return one(this, ".overlay .own", SVGElement);
  }

  /** @param {string} name */
  #button(name) {
    return one(this, `button.${name}`, HTMLButtonElement);
  }
}

/**
 * Two digits, three from 100 on: as `milliseconds` of the builder's quantities.py prints them.
 *
 * @param {number} value
 */
export function milliseconds(value) {
  const digits = value < 100 ? 2 : 3;
  const rounded = Number(value.toPrecision(digits));
  const power = rounded > 0 ? Math.floor(Math.log10(rounded)) : digits;
  return rounded.toFixed(Math.max(digits - 1 - power, 0));
}

/**
 * @param {Result[]} results
 * @param {Ladder} ladder
 */
function toCsv(results, ladder) {
  const errors = ladder.metrics.map((metric) => `${metric.id} (${metric.unit})`);
  const head = ["ladder", "tier", "median (ms)", "lower quartile (ms)", "upper quartile (ms)"];
  const rows = results.map((result) => [
    ladder.ladder,
    result.tier,
    ...[result.milliseconds, result.low_ms, result.high_ms].map(sixDigits),
    result.repeats,
    ...ladder.metrics.map((metric) => result.errors[metric.id] ?? (metric.higher ? "inf" : 0)),
  ]);
  const lines = [[...head, "samples", ...errors], ...rows];
  return lines.map((line) => `${line.map(csvField).join(",")}\r\n`).join("");
}

/**
 * More than a clock can tell, and without the noise of binary fractions.
 *
 * @param {number} value
 */
function sixDigits(value) {
  return Number(value.toPrecision(6));
}

/** @param {string | number} value */
function csvField(value) {
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
