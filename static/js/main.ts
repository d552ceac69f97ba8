/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import * as figures from "./editor/feature.js";
import * as ladders from "./ladder/bench.js";
import * as cases from "./page/case_filter.js";
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
import * as terms from "./page/terms.js";
import { installTheme, showTheme } from "./page/theme.js";
import { words } from "./page/words.js";
import * as keeping from "./question/keeping.js";
import * as questions from "./question/questions.js";

/** What a part of pages does. */
interface Part {
  /** Listen; called once. */
  install(): void;
  /** A page has come into place. */
  arrive?(): void;
  /** The address has become another one of the same page. */
  returned?(): void;
  /** The page is about to make way for another; its address may be that one's already. */
  leave?(page: string): void;
}
const PARTS: Part[] = [figures, ladders, cases, terms, questions, keeping];

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
