/** What a book with figures ships: the elements, and what the hand does with them. */

import { SimulationFigure } from "./element.js";
import { installGestures, offerWords, returned } from "./gestures.js";
import { readyNextVisit } from "../runtime/next_visit.js";
import { isAtRest, readyNext, watchHand } from "./next.js";
import { installStrips } from "./strip.js";

/** Called once; before links to other pages are listened for, since some are answered here. */
export function install() {
  customElements.define("simulation-figure", SimulationFigure);
  installStrips();
  installGestures();
  watchHand();
  readyNextVisit(isAtRest);
}

/** Called for each page. */
export function arrive() {
  offerWords();
  readyNext();
}

export { returned };
