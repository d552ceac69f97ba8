/**
 * `<ladder-bench>`: measures a ladder's tiers on the reader's device, one after another, in the
 * worker that also draws the figures. Chart and table are in the page already; what is measured
 * here is added to them.
 *
 * States, in `data-state`: `idle`, `running`, `done`, `stopped`, `failed`. A stop takes effect
 * when the tier at hand is finished.
 */

import { errorText } from "../errors.ts";
import { findAll, csv, data, find } from "../page/dom.ts";
import { numeral, words } from "../page/words.ts";
import { Runtime, sharedRuntime } from "../runtime/runtime.ts";
import { addPoint, type Ladder, type Result } from "./chart.ts";

/** After figures that the reader waits for. */
const URGENCY = () => -1;
/** Seconds spent on the samples of one tier. */
const BUDGET = 0.4;

/** Called once. */
export function install() {
  customElements.define("ladder-bench", LadderBench);
}

class LadderBench extends HTMLElement {
  #listeners = new AbortController();
  #stopped = false;
  #file = "";

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

  disconnectedCallback() {
    this.#stopped = true;
    this.#listeners.abort();
    URL.revokeObjectURL(this.#file);
  }

  get ladder(): Ladder {
    return data(this, "script.ladder-data");
  }

  async #run(runtime: Runtime) {
    if (this.dataset.state === "running") return;
    const { ladder, tiers } = this.ladder;
    this.#begin();
    const results: Result[] = [];
    try {
      for (const { id: tier, label } of tiers) {
        if (this.#stopped) break;
        this.#showMessage(words("ladder.measuring", { tier: label }));
        const reply = await runtime.call("measure", { ladder, tier, budget: BUDGET }, URGENCY);
        if (!this.isConnected) return;
        results.push(JSON.parse(reply.result));
        this.#show(results);
      }
      const counts = { count: results.length, all: tiers.length };
      this.#end(this.#stopped ? "stopped" : "done", words("ladder.measured", counts));
    } catch (error) {
      this.#end("failed", words("ladder.broke_off", { reason: errorText(error) }));
    }
  }

  #begin() {
    this.#stopped = false;
    this.dataset.state = "running";
    this.#enable("stop", "run");
    this.#points.replaceChildren();
    for (const cell of findAll(this, "td.own", HTMLElement)) cell.textContent = "–";
    find(this, "progress", HTMLProgressElement).value = 0;
  }

  #stop() {
    this.#stopped = true;
    this.#showMessage(words("ladder.stopping"));
  }

  #end(state: string, text: string) {
    this.dataset.state = state;
    this.#enable("run", "stop");
    this.#showMessage(text);
  }

  /** One of the two buttons in place of the other, with its focus. */
  #enable(name: string, other: string) {
    const [button, left] = [this.#button(name), this.#button(other)];
    button.disabled = false;
    if (document.activeElement === left) button.focus({ preventScroll: true });
    left.disabled = true;
  }

  /** Chart, table, progress and file, after the newest of `results`, of which there are some. */
  #show(results: Result[]) {
    const result = results[results.length - 1];
    this.dataset.measured = String(results.length);
    addPoint(this.#points, result, this.ladder);
    const cell = find(this, `tr[data-tier="${CSS.escape(result.tier)}"] td.own`, HTMLElement);
    cell.textContent = numeral(milliseconds(result.milliseconds));
    find(this, "progress", HTMLProgressElement).value = results.length;
    URL.revokeObjectURL(this.#file);
    this.#file = URL.createObjectURL(new Blob([toCsv(results, this.ladder)], { type: "text/csv" }));
    const link = find(this, "a.download", HTMLAnchorElement);
    link.href = this.#file;
    link.download = `${this.ladder.ladder}.csv`;
    link.removeAttribute("aria-disabled");
  }

  #showMessage(text: string) {
    find(this, ".ladder-status", HTMLElement).textContent = text;
  }

  /** The group of the chart for points measured here. */
  get #points() {
    return find(this, ".overlay .own", SVGElement);
  }

  #button(name: string) {
    return find(this, `button.${name}`, HTMLButtonElement);
  }
}

/** Two digits, three from 100 on: as `milliseconds` of `site_builder/benchmarks/judgements.py` prints them. */
export function milliseconds(value: number) {
  const digits = value < 100 ? 2 : 3;
  const rounded = Number(value.toPrecision(digits));
  const power = rounded > 0 ? Math.floor(Math.log10(rounded)) : digits;
  return rounded.toFixed(Math.max(digits - 1 - power, 0));
}

function toCsv(results: Result[], { ladder, metrics }: Ladder) {
  const sixDigits = (value: number) => Number(value.toPrecision(6));
  const head = ["ladder", "tier", "median (ms)", "lower quartile (ms)", "upper quartile (ms)"];
  const errors = metrics.map(({ id, unit }) => `${id} (${unit})`);
  const rows = results.map((result) => [
    ladder,
    result.tier,
    ...[result.milliseconds, result.low_ms, result.high_ms].map(sixDigits),
    result.repeats,
    ...metrics.map(({ id, higher }) => result.errors[id] ?? (higher ? "inf" : 0)),
  ]);
  return csv([[...head, "samples", ...errors], ...rows]);
}
