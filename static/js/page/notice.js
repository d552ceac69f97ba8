/** A line at the foot of the window, for what concerns the whole page: said once, in nobody's way. */

import { maybe } from "./dom.js";
import { words } from "./words.js";

/**
 * Say it, in place of what was said before.
 *
 * @param {string} text
 * @param {{label: string, act: () => void}} [offer] A button that does something about it.
 */
export function notice(text, offer) {
  maybe(document, ".notice", HTMLElement)?.remove();
  const line = document.createElement("div");
  line.className = "notice";
  line.setAttribute("role", "status");
  document.body.append(line); // before it says something, so that this is read out
  const said = document.createElement("p");
  said.textContent = text;
  line.append(said);
  if (offer) {
    line.append(
      button(offer.label, () => {
        line.remove();
        offer.act();
      }),
    );
  }
  line.append(button(words("page.close"), () => line.remove()));
}

/**
 * @param {string} label
 * @param {() => void} act
 */
function button(label, act) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = label;
  made.addEventListener("click", act);
  return made;
}
