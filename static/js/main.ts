/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import { PARTS } from "./book_parts.js";
import { installContents } from "./page/contents.js";
import { ask as followScroll, installHeader } from "./page/header.js";
import { installKeys } from "./page/keys.js";
import { installNavigation } from "./page/navigate.js";
import { notice } from "./page/notice.js";
import { installOffline } from "./page/offline.js";
import { installPrefetch } from "./page/prefetch.js";
import { watchScripts } from "./page/release.js";
import { watchScrollers } from "./page/scrollers.js";
import { installSearch } from "./page/search.js";
import { watchSections } from "./page/sections.js";
import { FORGETFUL } from "./page/storage.js";
import { installTheme, showTheme } from "./page/theme.js";
import { words } from "./page/words.js";

installTheme();
addEventListener(FORGETFUL, () => notice(words("page.forgetful")));
installContents();
installHeader();
installSearch();
installKeys();
for (const part of PARTS) part.install();
arrive();
installOffline();
installPrefetch();
watchScripts();
installNavigation(
  () => {
    showTheme();
    followScroll();
    arrive();
  },
  () => {
    for (const part of PARTS) part.returned?.();
  },
  (page) => {
    for (const part of PARTS) part.leave?.(page);
  },
);

/** A page has come into place. */
function arrive() {
  for (const part of PARTS) part.arrive?.();
  watchSections();
  watchScrollers();
}
