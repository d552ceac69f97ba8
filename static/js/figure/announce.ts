import { LANGUAGE } from "../book.js";
import { setAttribute, setText } from "../page/text.ts";
import { figureText } from "../page/words.ts";

/** Milliseconds of rest after which a changed description is read out. */
const REST = 500;

/**
 * A function that writes text into `element`, once changes have come to rest: of a drag only the
 * result is announced. The text that a page opens with is not. The event `figure-rest` follows.
 */
export function announcer(element: HTMLElement): (text: string) => void {
  let timer = 0;
  return (text) => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const isArrival = navigator.userActivation?.hasBeenActive === false;
      element.setAttribute("aria-live", isArrival ? "off" : "polite");
      describe(element, text);
      element.dispatchEvent(new Event("figure-rest", { bubbles: true }));
    }, REST);
  };
}

/** Write what a figure shows, in the language of the page where a translation has it. */
export function describe(element: HTMLElement, text: string) {
  const said = figureText(text);
  setText(element, said);
  setAttribute(element, "lang", said === text ? LANGUAGE : document.documentElement.lang);
}
