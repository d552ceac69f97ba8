import { setText } from "../page/text.ts";

/** Milliseconds of rest after which a changed description is read out. */
const REST = 500;

/**
 * A function that writes text into `element`, once changes have come to rest: a drag is announced
 * by its result only, and what a page arrives with is not. The rest itself is told by `figure-rest`.
 */
export function announcer(element: Element): (text: string) => void {
  let timer = 0;
  return (text) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const isArrival = navigator.userActivation?.hasBeenActive === false;
      element.setAttribute("aria-live", isArrival ? "off" : "polite");
      setText(element, text);
      element.dispatchEvent(new Event("figure-rest", { bubbles: true }));
    }, REST);
  };
}
