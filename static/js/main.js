/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import { installContents } from "./contents.js";
import { SimulationFigure } from "./figure.js";
import { LadderBench } from "./ladder.js";
import { installNavigation } from "./navigate.js";
import { installQuizzes, restoreQuizzes } from "./quiz.js";
import { installTheme, showTheme } from "./theme.js";

customElements.define("simulation-figure", SimulationFigure);
customElements.define("ladder-bench", LadderBench);
installTheme();
installContents();
installQuizzes();
installNavigation(() => {
  showTheme();
  restoreQuizzes();
});
