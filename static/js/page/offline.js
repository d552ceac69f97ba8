/** Has the whole book kept on the device, once the page is at rest and where that costs nothing. */

import { isMetered } from "./data_saver.js";

/** Milliseconds between two looks at whether the figures have started. */
const LOOK = 1000;
/** Milliseconds after which the book is kept even if they have not. */
const PATIENCE = 60_000;
/** Milliseconds between two questions whether there is a new release. */
const AGAIN = 3_600_000;

/** Ask for it in the background; where service workers are not to be had, nothing happens. */
export function installOffline() {
  const { offline, root = "", assets = "" } = document.body.dataset;
  const workers = serviceWorkers();
  if (offline === undefined || !workers || isMetered()) return;
  const release = new URL(`${assets}js/main.js`, location.href).href;
  const tell = () => workers.controller?.postMessage({ assets: release });
  const address = new URL(`${root}sw.js`, location.href);
  workers.addEventListener("controllerchange", tell);
  tell();
  whenAtRest(() => keep(workers, address));
}

/** What keeps the book; nothing where the browser has none, or denies it as in a sandboxed frame. */
export function serviceWorkers() {
  try {
    return navigator.serviceWorker;
  } catch {
    return null;
  }
}

/**
 * @param {ServiceWorkerContainer} workers
 * @param {URL} address
 */
async function keep(workers, address) {
  try {
    const registration = await workers.register(address);
    setInterval(() => registration.update().catch(ignore), AGAIN);
  } catch {
    // Storage is denied, or the file cannot be had: the book is read from the network as before.
  }
}

/** The network is away for now; the next question may be answered. */
function ignore() {}

/** @param {() => void} act */
function whenAtRest(act) {
  const begun = performance.now();
  const look = () => {
    const starting = document.querySelector('simulation-figure[data-state="starting"]');
    const isLate = performance.now() - begun > PATIENCE;
    if (document.readyState === "complete" && (!starting || isLate)) act();
    else setTimeout(look, LOOK);
  };
  setTimeout(look, LOOK);
}
