/**
 * Messages of a waiting figure, and second attempts: of one frame at once, and of all figures at the
 * reader's request or when the network is back.
 */

import { allowStart } from "../page/data_saver.ts";
import { findAll } from "../page/dom.ts";
import { words } from "../page/words.ts";
import { RuntimeFailure, type Caller } from "../runtime/runtime.ts";
import { LEADS } from "./parts.ts";
import { showMessage, setState } from "./status.ts";

/** Seconds after which a figure shows what it waits for, and after which it offers another try. */
const REPORTED_AFTER = 4;
const OFFERED_AFTER = 16;

/**
 * Show what a figure waits for where that takes long. Each tick of the clock counts a second at most, so
 * that time in which the page could not run is no waiting.
 *
 * @param isNear Whether the reader may see the figure.
 * @returns Ends it.
 */
export function reportWaiting(figure: HTMLElement, runtime: Caller, isNear: () => boolean) {
  let ticks = 0;
  const timer = setInterval(() => {
    ticks += 1;
    if (ticks < REPORTED_AFTER || !isNear()) return;
    const isOffered = ticks >= OFFERED_AFTER;
    if (figure.querySelector(".figure-status.lasting") && !isOffered) return;
    const { what, file } = runtime.waitsFor;
    showMessage(figure, words(`figure.awaits_${what}`, { file }), {
      waiting: true,
      retry: isOffered,
    });
  }, 1000);
  return () => clearInterval(timer);
}

/** When the device last found a network again: earlier requests may have failed for lack of it. */
let onlineSince = 0;

addEventListener("online", () => {
  onlineSince = performance.now();
  retryAll();
});

/**
 * Attempt a frame; once more where the worker was lost, or the network was away.
 *
 * @param isWanted Whether the frame would still be shown.
 * @returns The error of the last attempt; undefined after success, or where it is wanted no more.
 */
export async function attemptTwice(
  figure: HTMLElement,
  attempt: () => Promise<void>,
  isWanted: () => boolean,
): Promise<unknown> {
  const begun = performance.now();
  try {
    await attempt();
    return undefined;
  } catch (error) {
    const { kind, begun: worker } =
      error instanceof RuntimeFailure ? error : { kind: "page", begun: Infinity };
    // A request made since then may have joined a start of Python from before.
    if (kind !== "lost" && onlineSince <= Math.min(begun, worker)) return error;
  }
  setState(figure, "starting");
  if (!isWanted()) return undefined;
  return attempt().then(
    () => undefined,
    (error) => error,
  );
}

/** Start all figures, as the reader has started one. */
export function startAll() {
  allowStart();
  callAll("waiting", "begin");
}

/** Retry all failed figures: most often they failed for one reason. */
export function retryAll() {
  callAll("failed", "retry");
}

function callAll(state: "waiting" | "failed", method: "begin" | "retry") {
  for (const figure of findAll(document, `${LEADS}[data-state="${state}"]`, HTMLElement)) {
    (figure as any)[method]();
  }
}
