/**
 * Entry point: everything that a script adds to a page that is complete without one.
 * Listeners sit on the document, so that they outlive a change of chapter.
 */

import * as figures from "./editor/feature.ts";
import * as instruments from "./instrument/feature.ts";
import * as ladders from "./ladder/bench.ts";
import * as cases from "./page/case_filter.ts";
import * as deeper from "./page/deeper.ts";
import * as keys from "./page/keys.ts";
import { installParts } from "./page/navigate.ts";
import { showNotice } from "./page/notice.ts";
import * as offline from "./page/offline.ts";
import * as release from "./page/release.ts";
import * as scrolling from "./page/scrolling.ts";
import * as search from "./page/search.ts";
import { STORAGE_FAILED } from "./page/storage.ts";
import * as terms from "./page/terms.ts";
import * as theme from "./page/theme.ts";
import { words } from "./page/words.ts";
import * as progress from "./question/progress.ts";
import * as questions from "./question/questions.ts";

const AIDS = [theme, deeper, search, keys, cases, terms, scrolling, offline, release];

addEventListener(STORAGE_FAILED, () => showNotice(words("page.storage_failed")));
installParts([figures, instruments, ladders, questions, progress, ...AIDS]);
