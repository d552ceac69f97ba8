import { setText } from "../page/text.ts";

/** Milliseconds of rest after which a changed description is read out. */
const REST = 500;

/**
 * A function that writes text into `element`, a polite live region, once changes have come to
 * rest: a drag is announced by its result only. The rest itself is told by `figure-rest`.
 */
export function announcer(element: Element): (text: string) => void {
  element.setAttribute("aria-live", "polite");
  let timer = 0;
  return (text) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      setText(element, text);
      element.dispatchEvent(new Event("figure-rest", { bubbles: true }));
    }, REST);
  };
}
