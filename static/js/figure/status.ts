/**
 * The status of a figure: the message below it, the description that is read out, and attributes.
 * `data-state`: `still` as built; `waiting` for the reader to ask, where the link is metered;
 * `starting` once a frame is requested; `live` after each painted frame; `failed` with a message and a
 * button. `data-frames` counts frames after their pixels are in the page, `data-late` those that came
 * later than two display frames; `data-level` is the level of accuracy of the frame that is shown.
 */

import { errorText } from "../errors.ts";
import { clearStartCount } from "../page/data_saver.ts";
import { find } from "../page/dom.ts";
import { offerRelease } from "../page/release.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import { IN_TIME } from "./chooser.ts";
import { RuntimeFailure } from "../runtime/runtime.ts";
import { withParts } from "./parts.ts";

/**
 * Show `message` under the figure, or nothing.
 *
 * @param options Whether to offer another try, or to start Python at all; whether the message is no
 *   failure, and stays when a frame comes, or is of a frame that is awaited.
 */
export function showMessage(
  figure: HTMLElement,
  message: string,
  {
    retry = false,
    begin = false,
    lasting = false,
    waiting = false,
  }: { retry?: boolean; begin?: boolean; lasting?: boolean; waiting?: boolean } = {},
) {
  for (const each of withParts(figure)) {
    const status = find(each, ".figure-status", HTMLElement);
    setText(find(each, ".figure-message", HTMLElement), message);
    status.hidden = !message;
    status.classList.toggle("lasting", lasting);
    status.classList.toggle("waiting", waiting);
    find(each, ".retry", HTMLButtonElement).hidden = !retry;
    find(each, ".begin", HTMLButtonElement).hidden = !begin;
  }
}

/** Set the state of a figure, and of its parts. */
export function setState(figure: HTMLElement, state: string) {
  for (const each of withParts(figure)) {
    if (each.dataset.state !== state) each.dataset.state = state;
  }
}

/** Clear the message about a missing frame, as one has come. */
export function clearFailure(figure: HTMLElement) {
  if (!figure.querySelector(".figure-status.lasting")) showMessage(figure, "");
}

/**
 * A frame has been painted, of a figure and its parts.
 *
 * @param job Its tier, and the time of the event that it answers.
 */
export function showLive(
  figure: HTMLElement,
  job: { tier: string; time: number },
  computeMs: number,
) {
  const latencyMs = performance.now() - job.time;
  const isLate = figure.dataset.state === "live" && latencyMs > IN_TIME;
  const isFirst = figure.dataset.state !== "live";
  for (const { dataset } of withParts(figure)) {
    dataset.computeMs = computeMs.toFixed(1);
    dataset.latencyMs = latencyMs.toFixed(1);
    dataset.late = String(Number(dataset.late ?? 0) + Number(isLate));
    if (dataset.level !== job.tier) dataset.level = job.tier;
    dataset.frames = String(Number(dataset.frames ?? 0) + 1);
    if (dataset.state !== "live") dataset.state = "live";
  }
  if (isFirst) clearStartCount();
  figure.dispatchEvent(new Event("painted"));
}

export function showFailure(figure: HTMLElement, error: unknown) {
  setState(figure, "failed");
  const { kind, loadError = "" } = error instanceof RuntimeFailure ? error : { kind: "page" };
  if (["status", "other"].includes(loadError)) offerRelease();
  showMessage(figure, words(`figure.${kind}`, { reason: errorText(error) }), { retry: true });
  figure.dispatchEvent(new Event("figure-rest", { bubbles: true }));
}

/** Milliseconds of rest after which a changed description is read out. */
const REST = 500;

/**
 * A function that writes text into the description of a figure, and of its parts, once changes have come to rest: of a drag only the
 * result is announced. The text that a page opens with is not. The event `figure-rest` follows.
 */
export function announcer(figures: HTMLElement[]): (text: string) => void {
  const [element, ...others] = figures.map((each) => find(each, ".description", HTMLElement));
  let timer = 0;
  return (text) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const isArrival = navigator.userActivation?.hasBeenActive === false;
      element.setAttribute("aria-live", isArrival ? "off" : "polite");
      setText(element, text);
      for (const other of others) setText(other, text);
      element.dispatchEvent(new Event("figure-rest", { bubbles: true }));
    }, REST);
  };
}
