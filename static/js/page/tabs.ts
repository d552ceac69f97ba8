/**
 * Alternatives of which one is on show, chosen by a row of tabs above them. The page has them one
 * below the other, each with its title, and so they stay on paper and where no script runs.
 */

import { all, maybe, within } from "./dom.js";
import { hashTarget } from "./navigate.js";

const STEPS = new Map([
  ["ArrowRight", 1],
  ["ArrowLeft", -1],
]);

/** Listeners on the document, so that they outlive a change of chapter. */
export function install() {
  document.addEventListener("click", (event) => {
    const tab = within(event, ".tab-list > button", HTMLButtonElement);
    if (tab) choose(tab);
  });
  document.addEventListener("keydown", (event) => {
    const tab = within(event, ".tab-list > button", HTMLButtonElement);
    if (!tab || event.altKey || event.ctrlKey || event.metaKey) return;
    const next = neighbour(tab, event.key);
    if (!next) return;
    event.preventDefault();
    choose(next);
    next.focus();
  });
  // What is looked for in the page, or led to, is on show.
  document.addEventListener("beforematch", (event) => {
    if (event.target instanceof Element) reveal(event.target);
  });
  addEventListener("hashchange", revealTarget);
}

/** Give every group of a page its row of tabs, and show the first, or what the address names. */
export function arrive() {
  for (const group of all(document, ".tabs:not(.arranged)", HTMLElement)) {
    const list = document.createElement("div");
    list.className = "tab-list";
    list.setAttribute("role", "tablist");
    list.append(...panelsOf(group).map(tabFor));
    group.prepend(list);
    group.classList.add("arranged");
    const first = maybe(list, "button", HTMLButtonElement);
    if (first) choose(first);
  }
  revealTarget();
}

function tabFor(panel: HTMLElement) {
  const tab = document.createElement("button");
  const title = maybe(panel, ":scope > .tab-title", HTMLElement);
  tab.type = "button";
  tab.id = `${panel.id}-tab`;
  tab.setAttribute("role", "tab");
  tab.setAttribute("aria-controls", panel.id);
  if (title) tab.append(...[...title.childNodes].map((node) => node.cloneNode(true)));
  panel.setAttribute("role", "tabpanel");
  panel.setAttribute("aria-labelledby", tab.id);
  return tab;
}

function choose(chosen: HTMLButtonElement) {
  const list = chosen.parentElement;
  if (!list) return;
  for (const tab of all(list, "button", HTMLButtonElement)) {
    tab.setAttribute("aria-selected", String(tab === chosen));
    tab.tabIndex = tab === chosen ? 0 : -1;
    const panel = document.getElementById(tab.getAttribute("aria-controls") ?? "");
    if (tab === chosen) panel?.removeAttribute("hidden");
    else panel?.setAttribute("hidden", "until-found");
  }
}

function neighbour(tab: HTMLButtonElement, key: string) {
  const tabs = tab.parentElement ? all(tab.parentElement, "button", HTMLButtonElement) : [];
  if (key === "Home") return tabs.at(0);
  if (key === "End") return tabs.at(-1);
  const step = STEPS.get(key);
  return step ? tabs.at((tabs.indexOf(tab) + step) % tabs.length) : undefined;
}

function panelsOf(group: HTMLElement) {
  return all(group, ":scope > .tab", HTMLElement);
}

function reveal(inside: Element) {
  const panel = inside.closest(".tab");
  if (!panel) return;
  const tab = document.getElementById(`${panel.id}-tab`);
  if (tab instanceof HTMLButtonElement) choose(tab);
  if (panel.parentElement) reveal(panel.parentElement);
}

function revealTarget() {
  const target = hashTarget();
  if (!target?.closest(".tab[hidden]")) return;
  reveal(target);
  target.scrollIntoView();
}
