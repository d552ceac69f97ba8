/**
 * `<simulation-figure>`: a still that comes alive in place.
 *
 * States, in `data-state`: `still` as served; `starting` once a frame is asked for; `live` after
 * each painted frame; `failed` with a message and a button. `data-frames` counts frames after
 * their pixels are in the page. `data-tier` is the accuracy of the frame that is shown.
 */

import { announcer } from "./announce.js";
import { controlElement, pressAction, readValues, showSliderValue } from "./controls.js";
import { Motion } from "./motion.js";
import { paint } from "./painter.js";
import { Runtime, sharedRuntime } from "./runtime.js";
import { LatestWins } from "./scheduler.js";
import { Accuracy, showStages } from "./workings.js";

/** A frame that the reader waits for goes before one that only should be ready. */
const URGENCY = { far: 0, near: 1, touched: 2 };
/** How often a frame is asked for again, by itself, after the worker was lost. */
const RESTARTS = 1;

/** @typedef {{values: string, tier: string, time: number, urgency: number}} Job */

let figures = 0;

export class SimulationFigure extends HTMLElement {
  /** @type {LatestWins<Job>} */
  #scheduler = new LatestWins((job) => this.#run(job));
  /** @type {IntersectionObserver | null} */
  #observer = null;
  /** @type {AbortController | null} */
  #listeners = null;
  #near = false;
  #asked = "";

  connectedCallback() {
    this.key = `figure-${++figures}`;
    this.schema = JSON.parse(this.querySelector("script.schema").textContent);
    this.form = this.querySelector("form.controls");
    this.runtime = sharedRuntime();
    if (!this.runtime) return;
    if (!Runtime.supported) {
      this.#refuse();
      return;
    }
    this.announce = announcer(this.querySelector(".description"));
    this.accuracy = new Accuracy(this, (job, urgency) => this.#askError(job, urgency));
    this.motion = new Motion(this.form, this.schema, (moving, time) => this.#ask(time, moving));
    this.#listen();
    this.#startInView();
  }

  disconnectedCallback() {
    this.#observer?.disconnect();
    this.#listeners?.abort();
    this.motion?.stop();
    this.accuracy?.stop();
    this.#scheduler.clear();
    this.runtime?.forget(this.key);
  }

  /** Ask for the first frame as soon as it is known whether the figure is in view. */
  #startInView() {
    this.dataset.state = "starting";
    this.#observer = new IntersectionObserver(
      ([entry]) => {
        this.#near = entry.isIntersecting;
        this.accuracy.near = this.#near;
        if (!this.#asked) this.#ask(performance.now(), false, URGENCY.far);
      },
      { rootMargin: "50% 0px" },
    );
    this.#observer.observe(this);
  }

  #listen() {
    this.#listeners = new AbortController();
    const { signal } = this.#listeners;
    const on = (target, type, handler) => target.addEventListener(type, handler, { signal });
    on(this.form, "submit", (event) => event.preventDefault());
    on(this.form, "input", (event) => this.#changed(event, true));
    on(this.form, "change", (event) => this.#changed(event, false));
    on(this.form, "click", (event) => this.#pressed(event));
    on(this.querySelector(".retry"), "click", retryAll);
  }

  #control(/** @type {Event} */ event) {
    const name = event.target.closest("[name]")?.getAttribute("name");
    return this.schema.controls.find((control) => control.name === name);
  }

  #changed(/** @type {Event} */ event, /** @type {boolean} */ dragging) {
    const control = this.#control(event);
    if (control?.kind === "slider") {
      this.motion.stop();
      showSliderValue(this.form, control);
    }
    this.#ask(event.timeStamp, dragging && this.#drafted(control));
  }

  #pressed(/** @type {Event} */ event) {
    const control = this.#control(event);
    if (control?.kind !== "action") return;
    if (control.drives) {
      this.motion.press(control, event.timeStamp);
    } else {
      pressAction(this.form, control);
      this.#ask(event.timeStamp, false);
    }
  }

  /** Ask for the frame of the form's present values, unless it is the one asked for last. */
  #ask(/** @type {number} */ time, /** @type {boolean} */ moving, urgency = URGENCY.touched) {
    if (!this.isConnected) return;
    const values = JSON.stringify(readValues(this.form, this.schema.controls));
    const tier = this.#tier(moving);
    const asked = `${values} ${tier}`;
    if (asked === this.#asked) return;
    this.#asked = asked;
    this.#scheduler.submit({ values, tier, time, urgency });
  }

  /** Whether a drag of this control is answered by drafts. */
  #drafted(/** @type {import("./controls.js").Control | undefined} */ control) {
    const { drafted, drafted_in: byTier } = this.schema;
    if (control?.kind !== "slider") return false;
    if (drafted.length === 0 || drafted.includes(control.name)) return true;
    return byTier[this.#chosen()]?.includes(control.name) ?? false;
  }

  /** The tier that the reader chose. */
  #chosen() {
    const { tiers, default_tier: settled } = this.schema;
    return tiers.length === 0 ? settled : controlElement(this.form, "tier").value;
  }

  /** The tier chosen, or the draft where that is cheaper and things are moving. */
  #tier(/** @type {boolean} */ moving) {
    const { tiers, draft_tier: draft } = this.schema;
    const chosen = this.#chosen();
    return moving && tiers.indexOf(draft) < tiers.indexOf(chosen) ? draft : chosen;
  }

  async #run(/** @type {Job} */ job) {
    for (let attempt = 0; ; attempt += 1) {
      try {
        const reply = await this.#call(job);
        if (this.isConnected) this.#show(JSON.parse(reply.meta), reply, job);
        return;
      } catch (error) {
        if (!this.isConnected) return;
        if (error.kind !== "lost" || attempt >= RESTARTS) {
          this.#fail(error);
          return;
        }
        this.dataset.state = "starting";
        if (this.#scheduler.stale) return;
      }
    }
  }

  #call(/** @type {Job} */ job) {
    const payload = {
      figure: this.key,
      scene: this.dataset.simulation,
      values: job.values,
      tier: job.tier,
    };
    const urgency = () => Math.max(job.urgency, this.#near ? URGENCY.near : URGENCY.far);
    return this.runtime.call("render", payload, urgency);
  }

  async #askError(job, urgency) {
    const payload = { figure: this.key, scene: this.dataset.simulation, ...job };
    return (await this.runtime.call("error", payload, urgency)).estimate;
  }

  #show(meta, reply, /** @type {Job} */ job) {
    paint(this, meta, reply.rasters);
    showStages(this, meta.stages);
    this.accuracy.shown(job, reply.computeMs, job.tier === this.#tier(false));
    this.announce(meta.description);
    this.#say("");
    this.dataset.computeMs = reply.computeMs.toFixed(1);
    this.dataset.latencyMs = (performance.now() - job.time).toFixed(1);
    this.dataset.tier = job.tier;
    this.dataset.frames = String(Number(this.dataset.frames ?? 0) + 1);
    this.dataset.state = "live";
  }

  #fail(/** @type {Error & {kind?: string}} */ error) {
    this.motion.stop();
    this.#asked = "";
    this.dataset.state = "failed";
    this.#say(`${REASONS[error.kind] ?? REASONS.page} (${error.message})`, true);
  }

  /** Try again what failed; the figure keeps its values. */
  retry() {
    this.dataset.state = "starting";
    this.#say("");
    this.#ask(performance.now(), false);
  }

  /** This browser cannot run the figure: say so once, and offer no dead controls. */
  #refuse() {
    this.form.hidden = true;
    this.dataset.state = "failed";
    this.#say("This figure stays as it is: the browser does not offer WebAssembly.");
  }

  /** Show `message` under the figure, or nothing. */
  #say(/** @type {string} */ message, retry = false) {
    this.querySelector(".figure-message").textContent = message;
    this.querySelector(".figure-status").hidden = !message;
    this.querySelector(".retry").hidden = !retry;
  }
}

/** What kept one figure from its frame has most often kept them all. */
function retryAll() {
  for (const figure of document.querySelectorAll('simulation-figure[data-state="failed"]')) {
    figure.retry();
  }
}

const REASONS = {
  start: "Python did not start, so the figure stands still.",
  lost: "The computation did not end, so the figure shows the frame before.",
  python: "This setting could not be computed.",
  page: "The frame could not be drawn.",
};
