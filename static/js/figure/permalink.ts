/**
 * The state of figures in the address of their page:
 * `?<figure id>.<setting>=<value>&…`, of settings that differ from the page's start. A page of the
 * figure's own, for frames in other pages, has them as `?<setting>=<value>&…`.
 *
 * A hand that moves a control replaces the present entry of the history once it rests, so that no
 * drag fills the history, and a reload or a return finds the figure as it was left. What jumps (a
 * link in the text, a reset) makes a new entry, so that Back undoes it.
 */

import { isAction } from "../../../simulations/engine/controls/action/kind.ts";
import { printable } from "../errors.ts";
import { findAll, data, find } from "../page/dom.ts";
import { changeHistory, isAddressCurrent } from "../page/navigate.ts";
import { words } from "../page/words.ts";
import {
  type Control,
  isEmbed,
  moveControls,
  prefixOf,
  readValues,
  type Schema,
  unfoldControls,
  type Value,
} from "./controls.ts";
import { KINDS } from "./control_kinds.js";
import { accuracyMenu } from "./levels.ts";
import { LEADS } from "./parts.ts";
import { showMessage } from "./status.ts";

/** How many settings of an address that mean nothing are named, and how much of each. */
const MOST_NAMED = 4;
const LONGEST_NAME = 60;

/** A figure's form, and all that can be set in it, the accuracy included. */
export function settingsOf(figure: HTMLElement) {
  const schema: Schema = data(figure, "script.schema");
  const { controls, values, tiers, tier } = schema;
  const accuracy = accuracyMenu(schema, words("figure.accuracy"));
  return {
    form: find(figure, "form.controls", HTMLFormElement),
    // A button that plays has no state worth keeping.
    controls: [...controls, ...(tiers.length ? [accuracy] : [])].filter(
      (control) => !isAction(control) || !control.drives,
    ),
    start: { ...values, tier } as Record<string, Value>,
  };
}

/**
 * The address of the page with a figure at some values; those of other figures stay.
 *
 * @param values What is left out is as the figure shows it.
 * @param search What the address says so far.
 * @param prefix Of the names of its settings there.
 */
function addressOf(
  figure: HTMLElement,
  values: Record<string, Value> = {},
  search: string = location.search,
  prefix: string = prefixOf(figure),
) {
  const { form, controls, start } = settingsOf(figure);
  const shown = { ...readValues(form, controls), ...values };
  const query = new URLSearchParams(search);
  for (const key of [...query.keys()]) if (key.startsWith(prefix)) query.delete(key);
  for (const { name } of controls) {
    if (shown[name] !== start[name]) query.set(prefix + name, String(shown[name]));
  }
  const url = new URL(location.href);
  url.search = query.toString();
  return url;
}

/** The address that shows another reader what this figure shows now, and nothing else. */
export function permalink(figure: HTMLElement) {
  const url = addressOf(figure, {}, "");
  if (!isEmbed()) url.hash = idOf(figure);
  return url.href;
}

/**
 * HTML of a frame that shows what this figure shows now, as wide as there is room.
 *
 * @param page The address of the figure's own page.
 * @param height Pixels of the frame.
 */
export function embedding(figure: HTMLElement, page: string, height: string) {
  const url = new URL(page, location.href);
  url.search = addressOf(figure, {}, "", "").search;
  const frame = document.createElement("iframe");
  const given = {
    src: url.href,
    title: data(figure, "script.schema").title,
    width: "100%",
    height,
    style: "border: 0",
    loading: "lazy",
    allow: "fullscreen; clipboard-write",
  };
  for (const [name, value] of Object.entries(given)) frame.setAttribute(name, value);
  return frame.outerHTML;
}

/** Put a figure's state, or the `values` that it is on its way to, into the address. */
export function record(
  figure: HTMLElement,
  entry: "replace" | "push",
  values?: Record<string, Value>,
) {
  const url = addressOf(figure, values);
  const id = idOf(figure);
  if (!isEmbed() && url.search.includes(`${id}.`)) url.hash = id; // so that the address is the figure's link
  // A figure that has left with its page has nothing to say in the address of the next.
  if (!figure.isConnected || !isAddressCurrent() || url.href === location.href) return;
  if (entry === "replace") changeHistory("replaceState", history.state, url);
  else changeHistory("pushState", { ...history.state, scroll: Math.round(scrollY) }, url);
}

/** Bring every figure of the page to where the address says, or back to the page's start. */
export function showAddress() {
  for (const figure of findAll(document, LEADS, HTMLElement)) applyAddress(figure);
}

/** Put the controls of a figure to where the address says, and the others to the page's start. */
export function applyAddress(figure: HTMLElement) {
  const { form, controls, start } = settingsOf(figure);
  const { values, ignored } = valuesInAddress(figure, controls);
  const wanted = { ...start, ...values };
  const shown = readValues(form, controls);
  const moved = controls.filter(({ name }) => shown[name] !== wanted[name]);
  unfoldControls(form, [...Object.keys(values), ...moved.map(({ name }) => name)]);
  moveControls(form, moved, wanted, "change");
  reportIgnored(figure, ignored);
}

/** What the address says of a figure, and what of it cannot be meant. */
function valuesInAddress(figure: HTMLElement, controls: Control[]) {
  const prefix = prefixOf(figure);
  const values: Record<string, Value> = {};
  const ignored = [];
  for (const [key, text] of new URLSearchParams(location.search)) {
    if (!key.startsWith(prefix)) continue;
    const name = key.slice(prefix.length);
    const control = controls.find((one) => one.name === name);
    const value = control && KINDS[control.kind].parse(control, text);
    if (value === undefined) ignored.push(`${name}=${text}`);
    else values[name] = value;
  }
  return { values, ignored };
}

/** Say what of the address was ignored, until the reader does something else. */
function reportIgnored(figure: HTMLElement, ignored: string[]) {
  if (ignored.length === 0) return;
  const named = ignored.slice(0, MOST_NAMED).map((text) => {
    return printable(text.length > LONGEST_NAME ? `${text.slice(0, LONGEST_NAME)}…` : text);
  });
  if (ignored.length > MOST_NAMED) named.push("…");
  showMessage(figure, words("figure.ignored", { settings: named.join(", ") }), { lasting: true });
  figure.addEventListener("input", () => showMessage(figure, ""), { once: true });
}

function idOf(figure: HTMLElement) {
  return figure.closest("figure")?.id ?? "";
}
