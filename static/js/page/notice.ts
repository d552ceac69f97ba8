/** A line at the foot of the window, for what concerns the whole page: said once, in nobody's way. */

import { maybe } from "./dom.ts";
import { words } from "./words.ts";

/**
 * Say it, in place of what was said before.
 *
 * @param offer A button that does something about it.
 */
export function notice(text: string, offer?: { label: string; act: () => void }) {
  maybe(document, ".notice", HTMLElement)?.remove();
  const line = document.createElement("div");
  line.className = "notice floats row box screen";
  line.role = "status";
  document.body.append(line); // before it says something, so that this is read out
  const said = document.createElement("p");
  said.textContent = text;
  line.append(said);
  for (const { label, act } of [...(offer ? [offer] : []), { label: words("page.close") }]) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.addEventListener("click", () => {
      line.remove();
      act?.();
    });
    line.append(button);
  }
}
