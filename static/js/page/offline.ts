/** Has the whole book stored on the device, once the page is at rest and where that costs nothing. */

import { isMetered } from "./data_saver.ts";

/** Milliseconds between two looks at whether the figures have started. */
const LOOK = 1000;
/** Milliseconds after which the book is stored even if they have not. */
const LONGEST = 60_000;
/** Milliseconds between two requests for a new release. */
const AGAIN = 3_600_000;

/** Ask for it in the background; where service workers are not to be had, nothing happens. */
export function installOffline() {
  const { offline, root = "", assets = "" } = document.body.dataset;
  const workers = serviceWorkers();
  if (offline === undefined || !workers || isMetered()) return;
  const release = new URL(`${assets}js/main.js`, location.href).href;
  const announce = () => workers.controller?.postMessage({ assets: release });
  const address = new URL(`${root}sw.js`, location.href);
  workers.addEventListener("controllerchange", announce);
  announce();
  const begun = performance.now();
  const look = () => {
    const starting = document.querySelector('simulation-figure[data-state="starting"]');
    const isLate = performance.now() - begun > LONGEST;
    if (document.readyState === "complete" && (!starting || isLate)) store(workers, address);
    else setTimeout(look, LOOK);
  };
  setTimeout(look, LOOK);
}

/** Null where the browser has none, or denies it as in a sandboxed frame. */
function serviceWorkers() {
  try {
    return navigator.serviceWorker;
  } catch {
    return null;
  }
}

async function store(workers: ServiceWorkerContainer, address: URL) {
  try {
    const registration = await workers.register(address);
    setInterval(() => registration.update().catch(() => {}), AGAIN); // the network may be away
  } catch {
    // Storage is denied, or the file does not arrive: the book is read from the network as before.
  }
}
