/**
 * What a figure tells of its own computation: what became of each stage, how long the frame took,
 * and how far it is from the truth. The last is asked for only while the figure rests.
 *
 * @typedef {{name: string, status: "computed" | "reused" | "skipped", reason: string}} Stage
 */

import { setText, withUnit } from "./text.js";

/** Milliseconds without a new frame after which the error is measured. */
const REST = 400;
/** Anything that the reader waits for goes before it. */
const LEAST_URGENT = () => -1;

/** @param {HTMLElement} figure @param {Stage[]} stages */
export function showStages(figure, stages) {
  const list = figure.querySelector(".stages > ol");
  if (!list) return;
  while (list.children.length < stages.length) {
    list.append(list.firstElementChild.cloneNode(true));
  }
  // A frame that refuses its values has no stages: its items wait for the next one.
  [...list.children].forEach((item, index) => {
    item.hidden = index >= stages.length;
    if (!item.hidden) showStage(item, stages[index]);
  });
  setText(figure.querySelector(".stages-count"), countStages(stages));
}

/** @param {Element} item @param {Stage} stage */
function showStage(item, stage) {
  item.dataset.status = stage.status;
  setText(item.querySelector(".stage-name"), stage.name);
  setText(item.querySelector(".stage-status"), stage.status);
  setText(item.querySelector(".stage-reason"), stage.reason);
}

/** `4 computed, 8 reused, 1 skipped`, as `figure_view.py` writes it. */
export function countStages(/** @type {Stage[]} */ stages) {
  const count = (status) => stages.filter((stage) => stage.status === status).length;
  return ["computed", "reused", "skipped"]
    .map((status) => `${count(status)} ${status}`)
    .join(", ");
}

/** The line with error and time under a figure that has a reference. */
export class Accuracy {
  /** @type {{values: string, tier: string} | null} What is shown and not yet judged. */
  #waiting = null;
  #timer = 0;
  #near = false;
  /** A figure's first frame also waits for its code to be loaded, and says so. */
  #frames = 0;

  /**
   * @param {HTMLElement} figure
   * @param {(job: {values: string, tier: string}, urgency: () => number) => Promise<any>} ask
   *   The next estimate for a frame: a readout, or null where there is no better one.
   */
  constructor(figure, ask) {
    this.line = figure.querySelector(".accuracy");
    this.ask = ask;
  }

  /** A frame was painted. `settled` is false for drafts: those are not judged. */
  shown(/** @type {{values: string, tier: string}} */ job, ms, settled) {
    if (!this.line) return;
    this.stop();
    this.#frames += 1;
    setText(this.line.querySelector(".accuracy-frame"), this.#frames > 1 ? "frame" : "first frame");
    setText(this.line.querySelector(".accuracy-ms"), withUnit(ms.toFixed(ms < 10 ? 1 : 0), "ms"));
    setText(this.line.querySelector(".accuracy-value"), "…");
    delete this.line.dataset.judged;
    if (!settled) return;
    this.#waiting = { values: job.values, tier: job.tier };
    this.#rest();
  }

  /** Figures far from view are not judged until the reader comes near. */
  set near(near) {
    this.#near = near;
    if (near) this.#rest();
  }

  stop() {
    clearTimeout(this.#timer);
    this.#waiting = null;
  }

  #rest() {
    clearTimeout(this.#timer);
    if (!this.#waiting || !this.#near) return;
    const job = this.#waiting;
    this.#timer = setTimeout(() => this.#judge(job), REST);
  }

  /** One estimate after another, each a call of its own, so that a drag never waits for all. */
  async #judge(job) {
    try {
      while (this.#waiting === job && this.#near) {
        const estimate = await this.ask(job, LEAST_URGENT);
        if (this.#waiting !== job) return;
        if (estimate === null) {
          this.#waiting = null;
          this.line.dataset.judged = "true";
          return;
        }
        this.#write(estimate);
      }
    } catch (error) {
      if (this.#waiting !== job) return;
      this.#waiting = null;
      this.#write({ label: "Error", text: `not measured (${error.message})`, unit: "" });
    }
  }

  #write({ label, text, unit }) {
    setText(this.line.querySelector(".accuracy-label"), label);
    setText(this.line.querySelector(".accuracy-value"), withUnit(text, unit));
  }
}
