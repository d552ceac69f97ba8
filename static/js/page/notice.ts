/** A line at the foot of the window, for what concerns the whole page: said once, in nobody's way. */

import { element, findOptional } from "./dom.ts";
import { words } from "./words.ts";

/** Say it, in place of what was said before; `offer` is a button that does something about it. */
export function showNotice(text: string, offer?: { label: string; act: () => void }) {
  findOptional(document, ".notice", HTMLElement)?.remove();
  const line = element("div", "notice floats row box screen");
  line.role = "status";
  document.body.append(line); // before it says something, so that this is read out
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
