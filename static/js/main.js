/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import { SimulationFigure } from "./figure/element.js";
import { installStrips } from "./figure/strip.js";
import { installGestures, offerWords, returned } from "./figure/gestures.js";
import { LadderBench } from "./ladder/bench.js";
import { installContents } from "./page/contents.js";
import { ask as followScroll, installHeader } from "./page/header.js";
import { installKeys } from "./page/keys.js";
import { installNavigation } from "./page/navigate.js";
import { watchScrollers } from "./page/scrollers.js";
import { installOffline } from "./page/offline.js";
import { installSearch } from "./page/search.js";
import { watchSections } from "./page/sections.js";
import { arrangeTabs, installTabs } from "./page/tabs.js";
import { installTerms } from "./page/terms.js";
import { installTheme, showTheme } from "./page/theme.js";
import { installKeeping } from "./question/keeping.js";
import { installPredictions, restorePredictions } from "./question/predictions.js";
import { installQuestions, restoreQuestions } from "./question/questions.js";

customElements.define("simulation-figure", SimulationFigure);
customElements.define("ladder-bench", LadderBench);
installTheme();
installContents();
installHeader();
installSearch();
installKeys();
installTerms();
installTabs();
arrangeTabs();
installStrips();
watchScrollers();
watchSections();
installQuestions();
installPredictions();
installKeeping();
installGestures();
restoreQuestions();
restorePredictions();
offerWords();
installOffline();
installNavigation(() => {
  showTheme();
  arrangeTabs();
  followScroll();
  watchScrollers();
  watchSections();
  restoreQuestions();
  restorePredictions();
  offerWords();
}, returned);
