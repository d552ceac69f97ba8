/**
 * `<ladder-bench>`: measures a ladder's tiers on the reader's device, one after another, in the
 * worker that also draws the figures. Chart and table are in the page already; what is measured
 * here is added to them.
 *
 * States, in `data-state`: `idle`, `running`, `done`, `stopped`, `failed`. A stop takes effect
 * when the tier at hand is finished.
 */

import { addPoint } from "./ladder-chart.js";
import { Runtime, sharedRuntime } from "./runtime.js";

/** Figures that the reader waits for go first. */
const URGENCY = -1;
/** Seconds spent on the samples of one tier. */
const BUDGET = 0.4;

/**
 * @typedef {{id: string, label: string, unit: string, higher: boolean}} Metric
 * @typedef {{tier: string, milliseconds: number, low_ms: number, high_ms: number,
 *   repeats: number, errors: Record<string, number | null>}} Result
 * @typedef {{ladder: string, metrics: Metric[], tiers: {id: string, label: string}[],
 *   time: import("./ladder-chart.js").Axis, error: import("./ladder-chart.js").Axis}} Ladder
 */

export class LadderBench extends HTMLElement {
  /** @type {AbortController | null} */
  #listeners = null;
  #stopped = false;
  #csv = "";

  connectedCallback() {
    /** @type {Ladder} */
    this.ladder = JSON.parse(this.querySelector("script.ladder-data").textContent);
    this.runtime = sharedRuntime();
    if (!this.runtime || !Runtime.supported) {
      this.dataset.unavailable = "";
      return;
    }
    this.#listeners = new AbortController();
    const { signal } = this.#listeners;
    this.#button("run").addEventListener("click", () => this.#run(), { signal });
    this.#button("stop").addEventListener("click", () => this.#stop(), { signal });
  }

  disconnectedCallback() {
    this.#stopped = true;
    this.#listeners?.abort();
    URL.revokeObjectURL(this.#csv);
  }

  async #run() {
    if (this.dataset.state === "running") return;
    this.#begin();
    /** @type {Result[]} */
    const results = [];
    try {
      for (const tier of this.ladder.tiers) {
        if (this.#stopped) break;
        this.#say(`Measuring ${tier.label} …`);
        results.push(await this.#measure(tier.id));
        if (!this.isConnected) return;
        this.#show(results);
      }
      this.#end(this.#stopped ? "stopped" : "done", this.#summary(results));
    } catch (error) {
      this.#end("failed", `The measurement broke off (${error.message}). You can try again.`);
    }
  }

  /** @returns {Promise<Result>} */
  async #measure(/** @type {string} */ tier) {
    const payload = { ladder: this.ladder.ladder, tier, budget: BUDGET };
    const reply = await this.runtime.call("measure", payload, () => URGENCY);
    return JSON.parse(reply.result);
  }

  #begin() {
    this.#stopped = false;
    this.dataset.state = "running";
    this.#enable("stop", "run");
    this.querySelector(".overlay .own").replaceChildren();
    for (const cell of this.querySelectorAll("td.own")) cell.textContent = "–";
    this.#progress(0);
  }

  #stop() {
    this.#stopped = true;
    this.#say("Stopping after this tier …");
  }

  #end(/** @type {string} */ state, /** @type {string} */ message) {
    this.dataset.state = state;
    this.#enable("run", "stop");
    this.#say(message);
  }

  /** One of the two buttons in place of the other; who stood on that one is led over. */
  #enable(/** @type {string} */ name, /** @type {string} */ other) {
    const [button, left] = [this.#button(name), this.#button(other)];
    button.disabled = false;
    if (document.activeElement === left) button.focus({ preventScroll: true });
    left.disabled = true;
  }

  /** Chart, table, progress and file, after the newest of `results`. */
  #show(/** @type {Result[]} */ results) {
    const result = results.at(-1);
    this.dataset.measured = String(results.length);
    addPoint(this.querySelector(".overlay .own"), result, this.ladder);
    const row = this.querySelector(`tr[data-tier="${CSS.escape(result.tier)}"]`);
    row.querySelector("td.own").textContent = milliseconds(result.milliseconds);
    this.#progress(results.length);
    this.#offer(results);
  }

  #summary(/** @type {Result[]} */ results) {
    const counted = `${results.length} of ${this.ladder.tiers.length} tiers measured here`;
    return `${counted}; the table and the chart show the medians.`;
  }

  /** A link to the numbers as a file. */
  #offer(/** @type {Result[]} */ results) {
    URL.revokeObjectURL(this.#csv);
    this.#csv = URL.createObjectURL(new Blob([toCsv(results, this.ladder)], { type: "text/csv" }));
    const link = this.querySelector("a.download");
    link.href = this.#csv;
    link.download = `${this.ladder.ladder}.csv`;
    link.removeAttribute("aria-disabled");
  }

  #progress(/** @type {number} */ count) {
    this.querySelector("progress").value = count;
  }

  #say(/** @type {string} */ message) {
    this.querySelector(".ladder-status").textContent = message;
  }

  /** @returns {HTMLButtonElement} */
  #button(/** @type {string} */ name) {
    return this.querySelector(`button.${name}`);
  }
}

/** Two digits, three from 100 on: as `milliseconds` of site_builder/quantities.py prints them. */
export function milliseconds(/** @type {number} */ value) {
  const digits = value < 100 ? 2 : 3;
  const rounded = Number(value.toPrecision(digits));
  const power = rounded > 0 ? Math.floor(Math.log10(rounded)) : digits;
  return rounded.toFixed(Math.max(digits - 1 - power, 0));
}

/** @param {Result[]} results @param {Ladder} ladder */
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

/** More than a clock can tell, and without the noise of binary fractions. */
function sixDigits(/** @type {number} */ value) {
  return Number(value.toPrecision(6));
}

function csvField(/** @type {string | number} */ value) {
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
