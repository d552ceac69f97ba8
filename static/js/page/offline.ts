/** Has the whole book stored on the device, once the page is at rest and where that costs nothing. */

import { errorText } from "../errors.ts";
import { STORAGE } from "../book.js";
import { findLoadError } from "../runtime/load_error.ts";
import { isMetered } from "./data_saver.ts";
import { findOptional } from "./dom.ts";
import { showNotice } from "./notice.ts";
import { words } from "./words.ts";

/** Milliseconds between two looks at whether the figures have started. */
const CHECK_MS = 1000;
/** Milliseconds after which the book is stored even if they have not. */
const LONGEST_WAIT_MS = 60_000;
/** Milliseconds between two requests for a new release. */
const UPDATE_MS = 3_600_000;

/** Store the book in the background, where the browser has service workers. */
export function install() {
  const { offline, root = "" } = document.body.dataset;
  const workers = serviceWorkers();
  if (offline === undefined || !workers || isMetered()) return;
  const address = new URL(`${root}sw.js`, location.href);
  workers.addEventListener("message", async ({ data }) => {
    reportNotStored(workers, data.problem || (await fileProblem(data.address)));
  });
  const begun = performance.now();
  const check = () => {
    const starting = document.querySelector('simulation-figure[data-state="starting"]');
    const isLate = performance.now() - begun > LONGEST_WAIT_MS;
    if (document.readyState === "complete" && (!starting || isLate)) register(workers, address);
    else setTimeout(check, CHECK_MS);
  };
  setTimeout(check, CHECK_MS);
}

/** Null where the browser has none, or denies it as in a sandboxed frame. */
function serviceWorkers() {
  try {
    return navigator.serviceWorker;
  } catch {
    return null;
  }
}

async function register(workers: ServiceWorkerContainer, address: URL) {
  setInterval(async () => {
    const registration = await workers.register(address).catch(() => null);
    registration?.update().catch(() => {}); // the network may be away
  }, UPDATE_MS);
  try {
    await workers.register(address);
  } catch (error) {
    reportNotStored(workers, await fileProblem(address.href, errorText(error)));
  }
}

/** @param otherwise The reason where nothing is wrong with the file. */
async function fileProblem(address: string, otherwise: string = "") {
  const { data } = await findLoadError(address);
  return (data.kind === "other" && otherwise) || words(`runtime.${data.kind}`, data);
}

/** Show once in a visit why the book can only be read from the network. */
function reportNotStored({ controller }: ServiceWorkerContainer, reason: string) {
  if (controller || findOptional(document, ".notice", HTMLElement)) return;
  const key = `${STORAGE}not-stored`;
  try {
    if (sessionStorage.getItem(key)) return;
    sessionStorage.setItem(key, "said");
  } catch {
    // The message appears on each page that is loaded.
  }
  showNotice(words("page.not_stored", { reason }));
}
