/** A line at the foot of the window, for messages about the whole page. */

import { element, findOptional } from "./dom.ts";
import { words } from "./words.ts";

/** Show a message in place of the last one, with a button where something is offered. */
export function showNotice(text: string, offer?: { label: string; act: () => void }) {
  findOptional(document, ".notice", HTMLElement)?.remove();
  const line = element("div", "notice floats row box screen");
  line.role = "status";
  document.body.append(line); // before it has a text, so that the text is read out
  line.append(element("p", "", text));
  for (const { label, act } of [...(offer ? [offer] : []), { label: words("page.close") }]) {
    const button = element("button", "", label);
    button.type = "button";
    button.addEventListener("click", () => {
      line.remove();
      act?.();
    });
    line.append(button);
  }
}
