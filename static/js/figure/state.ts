/**
 * What a figure says of itself, in `data-state`: `still` as built; `waiting` for the reader to ask,
 * where the link is metered; `starting` once a frame is requested; `live` after each painted frame;
 * `failed` with a message and a button. `data-frames` counts frames after their pixels are in the
 * page; `data-tier` is the accuracy of the frame that is shown.
 */

import { message } from "../errors.ts";
import { startSurvived } from "../page/data_saver.ts";
import { offerRelease } from "../page/release.ts";
import { words } from "../page/words.ts";
import { RuntimeFailure } from "../runtime/runtime.ts";
import { say } from "./status.ts";

/** @param job Its tier, and the time of the event that it answers. */
export function showLive(
  figure: HTMLElement,
  job: { tier: string; time: number },
  computeMs: number,
) {
  figure.dataset.computeMs = computeMs.toFixed(1);
  figure.dataset.latencyMs = (performance.now() - job.time).toFixed(1);
  if (figure.dataset.tier !== job.tier) figure.dataset.tier = job.tier;
  figure.dataset.frames = String(Number(figure.dataset.frames ?? 0) + 1);
  if (figure.dataset.state !== "live") {
    figure.dataset.state = "live";
    startSurvived();
  }
  figure.dispatchEvent(new Event("painted"));
}

export function showFailure(figure: HTMLElement, error: unknown) {
  figure.dataset.state = "failed";
  const { kind, loadError = "" } = error instanceof RuntimeFailure ? error : { kind: "page" };
  if (["status", "other"].includes(loadError)) offerRelease();
  say(figure, words(`figure.${kind}`, { reason: message(error) }), { retry: true });
  figure.dispatchEvent(new Event("figure-rest", { bubbles: true }));
}
