/** The line under a figure that says what went wrong. */

import { one } from "../page/dom.ts";
import { setText } from "../page/text.ts";

/**
 * Show `message` under the figure, or nothing.
 *
 * @param options Whether to offer another try, or to start Python at all; whether the message is no
 *   failure, and stays when a frame comes, or is of a frame that is awaited.
 */
export function say(
  figure: HTMLElement,
  message: string,
  {
    retry = false,
    begin = false,
    lasting = false,
    waiting = false,
  }: { retry?: boolean; begin?: boolean; lasting?: boolean; waiting?: boolean } = {},
) {
  const status = one(figure, ".figure-status", HTMLElement);
  setText(one(figure, ".figure-message", HTMLElement), message);
  status.hidden = !message;
  status.classList.toggle("lasting", lasting);
  status.classList.toggle("waiting", waiting);
  one(figure, ".retry", HTMLButtonElement).hidden = !retry;
  one(figure, ".begin", HTMLButtonElement).hidden = !begin;
}

/** A frame has come: what was said of the lack of one is over. */
export function clearFailure(figure: HTMLElement) {
  if (!figure.querySelector(".figure-status.lasting")) say(figure, "");
}
