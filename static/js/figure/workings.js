/**
 * What a figure tells of its own computation: what became of each stage, how long the frame took,
 * and how far it is from the truth. The last is asked for only while the figure rests and the
 * reader has this unfolded.
 *
 * @typedef {{name: string, status: "computed" | "reused" | "skipped", reason: Reason}} Stage
 * @typedef {string | Said[]} Reason A scene's own words, or what the engine says.
 */

import { message } from "../errors.js";
import { all, maybe } from "../page/dom.js";
import { setText, withUnit } from "../page/text.js";
import { numeral, told, words } from "../page/words.js";

/** @import { Readout } from "./painter.js" */
/** @import { Said } from "../page/words.js" */
/** @typedef {{values: string, tier: string}} Judged */

/** Milliseconds without a new frame after which the error is measured. */
const REST = 400;
/** Anything that the reader waits for goes before it. */
const LEAST_URGENT = () => -1;

/**
 * @param {HTMLElement} figure
 * @param {Stage[]} stages
 */
export function showStages(figure, stages) {
  const list = maybe(figure, ".stages > ol", HTMLOListElement);
  const first = list?.firstElementChild;
  if (!list || !first) return;
  while (list.children.length < stages.length) list.append(first.cloneNode(true));
  // A frame that refuses its values has no stages: its items wait for the next one.
  for (const [index, item] of all(list, ":scope > li", HTMLLIElement).entries()) {
    item.hidden = index >= stages.length;
    if (!item.hidden) showStage(item, stages[index]);
  }
  setText(figure.querySelector(".stages-count"), countStages(stages));
}

/**
 * @param {HTMLElement} item
 * @param {Stage} stage
 */
function showStage(item, stage) {
  item.dataset.status = stage.status;
  setText(item.querySelector(".stage-name"), stage.name);
  setText(item.querySelector(".stage-status"), words(`workings.${stage.status}`));
  setText(item.querySelector(".stage-reason"), reasonText(stage.reason));
}

/**
 * Why a stage was computed or not, as `pages/views/simulation.py` writes it.
 *
 * @param {Reason} reason
 */
export function reasonText(reason) {
  return [reason].flat().map(told).join("; ");
}

/**
 * `4 computed, 8 reused, 1 skipped`, as `simulation_view.py` writes it.
 *
 * @param {Stage[]} stages
 */
export function countStages(stages) {
  const count = (/** @type {string} */ status) =>
    stages.filter((stage) => stage.status === status).length;
  const [computed, reused, skipped] = ["computed", "reused", "skipped"].map(count);
  return words("workings.count", { computed, reused, skipped });
}

/** The line with error and time under a figure that has a reference. */
export class Accuracy {
  /** @type {Judged | null} What is shown and not yet judged. */
  #waiting = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  #near = false;
  /** A figure's first frame also waits for its code to be loaded, and says so. */
  #frames = 0;

  /**
   * @param {HTMLElement} figure
   * @param {(job: Judged, urgency: () => number) => Promise<Readout | null>} ask
   *   The next estimate for a frame: a readout, or null where there is no better one.
   */
  constructor(figure, ask) {
    this.line = maybe(figure, ".accuracy", HTMLElement);
    this.fold = maybe(figure, "details.workings", HTMLDetailsElement);
    this.ask = ask;
    this.fold?.addEventListener("toggle", () => this.#rest());
  }

  /**
   * A frame was painted.
   *
   * @param {Judged} job
   * @param {number} ms
   * @param {boolean} settled False for drafts: those are not judged.
   */
  shown(job, ms, settled) {
    if (!this.line) return;
    this.stop();
    this.#frames += 1;
    setText(
      this.line.querySelector(".accuracy-frame"),
      words(this.#frames > 1 ? "workings.frame" : "workings.first_frame"),
    );
    setText(
      this.line.querySelector(".accuracy-ms"),
      withUnit(numeral(ms.toFixed(ms < 10 ? 1 : 0)), "ms"),
    );
    setText(this.line.querySelector(".accuracy-value"), "…");
    delete this.line.dataset.judged;
    if (!settled) return;
    this.#waiting = { values: job.values, tier: job.tier };
    this.#rest();
  }

  /**
   * Figures far from view are not judged until the reader comes near.
   *
   * @param {boolean} near
   */
  set near(near) {
    this.#near = near;
    if (near) this.#rest();
  }

  get #isSeen() {
    return this.#near && this.fold?.open;
  }

  stop() {
    clearTimeout(this.#timer);
    this.#waiting = null;
  }

  #rest() {
    clearTimeout(this.#timer);
    if (!this.#waiting || !this.#isSeen) return;
    const job = this.#waiting;
    this.#timer = setTimeout(() => this.#judge(job), REST);
  }

  /**
   * One estimate after another, each a call of its own, so that a drag never waits for all.
   *
   * @param {Judged} job
   */
  async #judge(job) {
    try {
      while (this.#waiting === job && this.#isSeen) {
        const estimate = await this.ask(job, LEAST_URGENT);
        if (this.#waiting !== job) return;
        if (estimate === null) {
          this.#waiting = null;
          if (this.line) this.line.dataset.judged = "true";
          return;
        }
        this.#write(estimate);
      }
    } catch (error) {
      if (this.#waiting !== job) return;
      this.#waiting = null;
      const text = words("workings.not_measured", { reason: message(error) });
      this.#write({ label: words("workings.error"), text, unit: "" });
    }
  }

  /** @param {Pick<Readout, "label" | "text" | "unit">} estimate */
  #write({ label, text, unit }) {
    setText(this.line?.querySelector(".accuracy-label"), label);
    setText(this.line?.querySelector(".accuracy-value"), withUnit(numeral(text), unit));
  }
}
