/**
 * A field above the tables of hard cases that shows only the cases with the words typed into it. It
 * offers the functions that were asked.
 * The tables are complete, and closed, without it.
 */

import { findAll, element, find } from "./dom.ts";
import { words } from "./words.ts";

/** Called once: a listener on the document outlives a change of chapter. */
export function install() {
  document.addEventListener("input", ({ target }) => {
    if (target instanceof HTMLInputElement && target.closest(".case-filter")) filterCases(target);
  });
}

/** Put the field above the first table of a page that has such tables. */
export function setUpPage() {
  const [first] = caseTables();
  if (!first || document.querySelector(".case-filter")) return;
  const field = element("form", "case-filter row fine screen");
  field.role = "search";
  field.innerHTML =
    '<label><span></span> <input type="search" list="case-functions"></label>' +
    '<datalist id="case-functions"></datalist> <span role="status"></span>';
  field.addEventListener("submit", (event) => event.preventDefault());
  find(field, "label > span", HTMLElement).textContent = words("extremes.filter");
  const calls = findAll(document, ".extremes td:first-child > code", HTMLElement);
  const functions = new Set(calls.flatMap((call) => /^[\w.]+\(/.exec(call.textContent) ?? []));
  const offered = [...functions].sort().map((name) => new Option("", name));
  find(field, "datalist", HTMLDataListElement).append(...offered);
  first.before(field);
}

function filterCases(input: HTMLInputElement) {
  const wanted = input.value.toLowerCase().split(/\s+/).filter(Boolean);
  let found = 0;
  for (const table of caseTables()) {
    const rows = findAll(table, "tbody tr", HTMLElement);
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !wanted.every((word) => text.includes(word));
    }
    const left = rows.filter((row) => !row.hidden).length;
    table.hidden = !left;
    table.open = wanted.length > 0 && left > 0;
    found += left;
  }
  const count = find(input.closest("form") ?? document, "[role=status]", HTMLElement);
  count.textContent = wanted.length ? words("extremes.found", { count: found }) : "";
}

function caseTables() {
  return findAll(document, "details.extremes", HTMLDetailsElement);
}
