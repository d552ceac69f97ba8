/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import { PARTS } from "./book_parts.js";
import { installContents } from "./page/contents.js";
import { ask as followScroll, installHeader } from "./page/header.js";
import { installKeys } from "./page/keys.js";
import { installNavigation } from "./page/navigate.js";
import { watchScrollers } from "./page/scrollers.js";
import { installOffline } from "./page/offline.js";
import { installSearch } from "./page/search.js";
import { watchSections } from "./page/sections.js";
import { installTheme, showTheme } from "./page/theme.js";

installTheme();
installContents();
installHeader();
installSearch();
installKeys();
for (const part of PARTS) part.install();
arrive();
installOffline();
installNavigation(
  () => {
    showTheme();
    followScroll();
    arrive();
  },
  () => {
    for (const part of PARTS) part.returned?.();
  },
);

/** A page has come into place. */
function arrive() {
  for (const part of PARTS) part.arrive?.();
  watchScrollers();
  watchSections();
}
