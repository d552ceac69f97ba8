/** What a book with figures ships: the elements, and gestures on them. */

import { SimulationFigure } from "./element.ts";
import { nudgeFirstHandle, watchHands } from "./nudge.ts";
import { installGestures, returned } from "./gestures.ts";
import { installPanelDots } from "./panel_dots.ts";
import { prewarmNext, watchInput } from "./prewarm.ts";

/** Called once; before links to other pages are listened for, since some are answered here. */
export function install() {
  customElements.define("simulation-figure", SimulationFigure);
  installPanelDots();
  installGestures();
  watchInput();
  watchHands();
}

/** Called for each page. */
export function arrive() {
  prewarmNext();
  nudgeFirstHandle();
}

export { returned };
