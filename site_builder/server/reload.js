// Only in pages that `site_builder serve` shows: updates an open page after a build, or shows the
// mistakes of a failed one. An edited paragraph or style sheet is replaced in place, so that scroll
// position, figures and answers stay; anything else reloads the page.
//
// Browsers open few connections to one host, so one page receives the events and posts them to the
// others.

const FIXED = "simulation-figure, ladder-bench, form, [data-predict], script, h1, h2, h3";
const channel = new BroadcastChannel("builds");
let shown = sentBuild();
let current = false; // whether the page is known to show the build numbered `shown`
let source = fetchSource();

channel.addEventListener("message", ({ data }) => receive(data));
channel.postMessage({ kind: "asked" });
if (navigator.locks) navigator.locks.request("builds", listen);
else listen();

/** For as long as this page is open. */
function listen() {
  const events = new EventSource("/.reload/events");
  /** @type {object | null} */
  let last = null;
  channel.addEventListener("message", ({ data }) => {
    if (data.kind === "asked" && last) channel.postMessage(last);
  });
  for (const kind of ["built", "failed"]) {
    events.addEventListener(kind, (event) => {
      const message = { kind, data: JSON.parse(event.data) };
      last = message;
      channel.postMessage(message);
      receive(message);
    });
  }
  return new Promise(() => {});
}

/** @param {{ kind: string, data: any }} message */
function receive({ kind, data }) {
  if (kind === "asked") return;
  document.getElementById("build-mistakes")?.remove();
  if (kind === "failed") showMistakes(data);
  else if (document.title === "Being built") location.reload();
  else {
    const before = shown || data.number;
    const missed = !current || data.number !== before + 1;
    current = true;
    shown = data.number;
    if (shown !== before) show(data.changed, missed);
  }
}

/** The build that the page is of; 0 where the browser does not say. */
function sentBuild() {
  const [load] = performance.getEntriesByType("navigation");
  const timings = /** @type {PerformanceNavigationTiming | undefined} */ (load)?.serverTiming ?? [];
  return Number(timings.find(({ name }) => name === "build")?.description ?? 0);
}

/**
 * @param {string[]} changed Files, relative to the site's root.
 * @param {boolean} missed Whether there were other builds in between.
 */
async function show(changed, missed) {
  const page = location.pathname.slice(1).replace(/(^|\/)$/, "$1index.html");
  const assets = changed.filter((name) => name.startsWith("assets/") && name !== sheet());
  const python = changed.some((name) => name.startsWith("runtime/"));
  const mine = changed.includes(page) || pictures().some((name) => changed.includes(name));
  const scripts = assets.some((name) => /\/(js|fonts|editor|search)\//.test(name));
  if (missed || scripts || python) return location.reload();
  if (changed.includes(sheet())) swapSheet();
  if (mine && !(changed.includes(page) && (await swapText()))) location.reload();
}

function sheet() {
  return new URL(link().href).pathname.slice(1);
}

function link() {
  return /** @type {HTMLLinkElement} */ (document.querySelector('link[rel="stylesheet"]'));
}

function pictures() {
  return [...document.querySelectorAll("img[src]")].map((image) =>
    new URL(/** @type {HTMLImageElement} */ (image).src).pathname.slice(1),
  );
}

/** The old sheet stays until the new one has loaded, so that nothing flashes. */
function swapSheet() {
  const old = link();
  const fresh = /** @type {HTMLLinkElement} */ (old.cloneNode());
  const address = new URL(old.href);
  address.searchParams.set("build", String(shown));
  fresh.href = address.href;
  fresh.addEventListener("load", () => old.remove());
  old.after(fresh);
}

/** The page as it was sent, without the changes that scripts have made. */
async function fetchSource() {
  const reply = await fetch(location.pathname, { cache: "no-cache" });
  return new DOMParser().parseFromString(await reply.text(), "text/html");
}

/** Replace the paragraphs that differ; false where more than text has changed. */
async function swapText() {
  const before = await source;
  source = fetchSource();
  const after = await source;
  const now = blocks(document);
  const [old, fresh] = [blocks(before), blocks(after)];
  if (!old.length || now.length !== old.length || rest(before) !== rest(after)) return false;
  let start = 0;
  while (start < old.length && old[start].outerHTML === fresh[start]?.outerHTML) start += 1;
  let end = 0;
  const most = Math.min(old.length, fresh.length) - start;
  while (end < most && old.at(-1 - end)?.outerHTML === fresh.at(-1 - end)?.outerHTML) end += 1;
  const gone = now.slice(start, now.length - end);
  const come = fresh.slice(start, fresh.length - end);
  if ([...gone, ...come].some((block) => block.matches(FIXED) || block.querySelector(FIXED)))
    return false;
  const anchor = now[start - 1];
  if (!anchor) return false;
  anchor.after(...come.map((block) => document.importNode(block, true)));
  for (const block of gone) block.remove();
  return true;
}

/** @param {Document} page */
function blocks(page) {
  return [...(page.querySelector("main > article")?.children ?? [])];
}

/**
 * All but the text.
 *
 * @param {Document} page
 */
function rest(page) {
  const copy = /** @type {Document} */ (page.cloneNode(true));
  for (const block of blocks(copy)) block.remove();
  return copy.documentElement.outerHTML;
}

/** @param {string} mistakes */
function showMistakes(mistakes) {
  const report = document.createElement("pre");
  report.id = "build-mistakes";
  report.setAttribute("role", "alert");
  report.textContent = mistakes;
  report.style.cssText =
    "position:fixed;inset:auto 0 0 0;z-index:99;max-height:60vh;margin:0;padding:1rem 1.5rem;" +
    "overflow:auto;white-space:pre-wrap;font:14px/1.5 monospace;background:#3b0d0d;color:#fff";
  document.body.append(report);
}
