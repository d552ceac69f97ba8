/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import * as figures from "./editor/feature.ts";
import * as instruments from "./instrument/feature.ts";
import * as ladders from "./ladder/bench.ts";
import * as cases from "./page/case_filter.ts";
import { installKeys } from "./page/keys.ts";
import { installNavigation } from "./page/navigate.ts";
import { notice } from "./page/notice.ts";
import { installOffline } from "./page/offline.ts";
import { installPrefetch } from "./page/prefetch.ts";
import { watchScripts } from "./page/release.ts";
import * as scrolling from "./page/scrolling.ts";
import { installSearch } from "./page/search.ts";
import { FORGETFUL } from "./page/storage.ts";
import * as terms from "./page/terms.ts";
import { installTheme, showTheme } from "./page/theme.ts";
import { useWordsOf, words } from "./page/words.ts";
import * as progress from "./question/progress.ts";
import * as questions from "./question/questions.ts";

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
const PARTS: Part[] = [figures, instruments, ladders, cases, terms, questions, progress, scrolling];

useWordsOf(document);
installTheme();
addEventListener(FORGETFUL, () => notice(words("page.forgetful")));
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
}
