/** Second attempts: of one frame at once, and of all figures when the reader or the network asks. */

import { stopSparing } from "../page/data_saver.ts";
import { all } from "../page/dom.ts";
import { RuntimeFailure } from "../runtime/runtime.ts";

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
  figure.dataset.state = "starting";
  if (!isWanted()) return undefined;
  return attempt().then(
    () => undefined,
    (error) => error,
  );
}

/** The reader has asked for Python in one figure: all start. */
export function beginAll() {
  stopSparing();
  callAll("waiting", "begin");
}

/** What kept one figure from its frame has most often kept them all. */
export function retryAll() {
  callAll("failed", "retry");
}

function callAll(state: "waiting" | "failed", method: "begin" | "retry") {
  for (const figure of all(document, `simulation-figure[data-state="${state}"]`, HTMLElement)) {
    (figure as any)[method]();
  }
}
