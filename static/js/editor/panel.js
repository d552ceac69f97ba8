/** The workshop in the page: the parts of a figure's Python, an editor, and what came of running. */

import { all, one } from "../page/dom.js";
import { setText } from "../page/text.js";
import { reasonText } from "../figure/stage_report.js";
import { nameOf } from "./sources.js";
import { words } from "../page/words.js";

/** @import { CodeEditor } from "../../../site_builder/editor/code_editor.js" */
/** @import { Stage } from "../figure/stage_report.js" */
/** @import { Problem } from "./edited_runtime.js" */
/** @import { Edits } from "./edits.js" */
/** @import { Sources } from "./sources.js" */

/**
 * What the reader does with the panel.
 *
 * @typedef {object} Wishes
 * @property {() => void} changed A text was changed; `key` and `text` of the panel tell which.
 * @property {() => void} run
 * @property {(key: string) => void} putBack
 * @property {() => void} putAllBack
 * @property {() => void} download
 * @property {() => void} close
 */

export class Panel {
  /** @type {CodeEditor | null} */
  #editor = null;
  /** Key of the definition that is shown. */
  key = "";

  /**
   * @param {HTMLElement} element
   * @param {string} id Begins the ids of its parts.
   * @param {Sources} sources
   * @param {Edits} edits
   * @param {Wishes} wishes
   */
  constructor(element, id, sources, edits, wishes) {
    this.element = element;
    this.sources = sources;
    this.edits = edits;
    this.wishes = wishes;
    this.hint = one(element, ".workshop-hint", HTMLElement);
    this.hint.id = `${id}-hint`;
    this.#listParts();
    this.#listen();
  }

  /** The text in the editor. */
  get text() {
    return this.#editor?.text ?? "";
  }

  /**
   * Let the reader write, with this editor.
   *
   * @param {typeof CodeEditor} Editor
   */
  edit(Editor) {
    this.#editor = new Editor(one(this.element, ".workshop-code", HTMLElement), {
      hint: this.hint.id,
      changed: () => this.wishes.changed(),
      run: () => this.wishes.run(),
    });
  }

  /**
   * Let the reader only read.
   *
   * @param {string} why
   */
  readOnly(why) {
    const listing = document.createElement("pre");
    listing.tabIndex = 0;
    listing.className = "code";
    one(this.element, ".workshop-code", HTMLElement).append(listing);
    this.hint.textContent = why;
    this.element.classList.add("read-only");
  }

  /** Focus goes to the parts. */
  focus() {
    this.element.querySelector("button")?.focus();
  }

  leave() {
    this.#editor?.destroy();
    this.element.remove();
  }

  /**
   * Show a definition: the reader's text if there is one, else the book's.
   *
   * @param {string} key
   */
  open(key) {
    const { path, line, text, uses } = this.sources.definitions[key];
    const name = nameOf(key);
    this.key = key;
    this.#write(
      key,
      this.edits.text(key) ?? text,
      line,
      words("workshop.in_file", { name, file: path }),
    );
    setText(one(this.element, ".place-name", HTMLElement), name);
    setText(one(this.element, ".path", HTMLElement), path);
    setText(one(this.element, ".place-line", HTMLElement), String(line));
    this.#listUses(uses);
    this.refresh();
  }

  /** Show the book's text again, as a step that can be undone. */
  putBack() {
    this.#editor?.replace(this.sources.definitions[this.key].text);
  }

  /** What depends on which texts are the reader's. */
  refresh() {
    const { edits, key } = this;
    const edited = edits.text(key) !== null;
    one(this.element, ".place-edited", HTMLElement).hidden = !edited;
    one(this.element, ".workshop-offer", HTMLElement).hidden = edited || !edits.all.has(key);
    one(this.element, ".put-back", HTMLButtonElement).disabled = !edited;
    one(this.element, ".put-all-back", HTMLButtonElement).disabled = edits.all.size === 0;
    one(this.element, ".download", HTMLButtonElement).disabled = edits.all.size === 0;
    for (const part of all(this.element, ".workshop-part", HTMLButtonElement)) {
      const { definition = "" } = part.dataset;
      part.toggleAttribute("data-edited", edits.text(definition) !== null);
      if (definition === key) part.setAttribute("aria-current", "true");
      else part.removeAttribute("aria-current");
    }
  }

  /**
   * What became of each stage in the frame that is shown.
   *
   * @param {Stage[]} stages
   */
  showStages(stages) {
    const done = new Map(stages.map((stage) => [stage.name, stage]));
    for (const part of all(this.element, ".workshop-part", HTMLButtonElement)) {
      const stage = done.get(part.dataset.stage ?? "");
      const status = part.dataset.stage ? (stage?.status ?? "") : "computed";
      part.dataset.status = status;
      part.title = reasonText(stage?.reason ?? "");
      setText(part.querySelector(".part-status"), status && words(`workings.${status}`));
    }
  }

  /**
   * What came of running.
   *
   * @param {string} told
   * @param {Problem} [problem]
   */
  tell(told, problem) {
    const place = one(this.element, ".result-place", HTMLButtonElement);
    const { definition = "", line = 0 } = problem ?? {};
    const known = this.sources.definitions[definition];
    one(this.element, ".workshop-result", HTMLElement).classList.toggle("failed", !!problem);
    setText(one(this.element, ".result-words", HTMLElement), told);
    place.hidden = !known || line === 0;
    place.dataset.definition = definition;
    place.dataset.line = String(line);
    const where = { line: line + (known?.line ?? 0) - 1, name: nameOf(definition) };
    if (known) setText(place, words("workshop.line", where));
    this.#editor?.mark(definition === this.key ? line : 0);
  }

  /** @param {string} printed */
  print(printed) {
    const box = one(this.element, ".workshop-printed", HTMLElement);
    box.hidden = !printed;
    setText(box, printed);
  }

  /** @param {boolean} busy Whether the code runs: it cannot be run or put back meanwhile. */
  set busy(busy) {
    for (const button of all(this.element, ".run, .put-back, .put-all-back", HTMLButtonElement)) {
      button.setAttribute("aria-disabled", String(busy));
    }
  }

  #listParts() {
    const list = one(this.element, ".workshop-parts", HTMLOListElement);
    const model = one(list, "li", HTMLLIElement);
    const parts = this.sources.stages.map((stage) => ({ ...stage, stage: stage.name }));
    parts.push({ name: words("workshop.drawing"), definition: this.sources.draw, stage: "" });
    for (const { name, definition, stage } of parts.filter((part) => part.definition)) {
      const item = model.cloneNode(true);
      if (!(item instanceof HTMLLIElement)) return;
      const button = one(item, "button", HTMLButtonElement);
      Object.assign(button.dataset, { definition, stage });
      setText(button.querySelector(".part-name"), name);
      list.append(item);
    }
    model.remove();
  }

  /** @param {string[]} uses */
  #listUses(uses) {
    const list = one(this.element, ".uses-list", HTMLElement);
    const buttons = all(list, ".use", HTMLButtonElement);
    const [model] = buttons;
    list.replaceChildren(
      ...(uses.length > 0 ? uses : [""]).map((key) => {
        const button = model.cloneNode();
        if (!(button instanceof HTMLButtonElement)) throw new Error("no button");
        button.dataset.definition = key;
        button.textContent = nameOf(key);
        return button;
      }),
    );
    one(this.element, ".workshop-uses", HTMLElement).hidden = uses.length === 0;
  }

  /**
   * @param {string} key
   * @param {string} text
   * @param {number} firstLine
   * @param {string} label
   */
  #write(key, text, firstLine, label) {
    if (this.#editor) this.#editor.open({ key, text, firstLine, label });
    else one(this.element, ".workshop-code > pre", HTMLElement).textContent = text;
  }

  #listen() {
    /** @type {Record<string, () => void>} */
    const actions = {
      ".run": () => this.wishes.run(),
      ".put-back": () => this.wishes.putBack(this.key),
      ".put-all-back": () => this.wishes.putAllBack(),
      ".download": () => this.wishes.download(),
      ".close": () => this.wishes.close(),
      ".offer-show": () => this.#editor?.replace(this.edits.all.get(this.key)?.text ?? ""),
      ".offer-forget": () => this.#forget(),
      ".result-place": () => this.#goToProblem(),
    };
    this.element.addEventListener("click", (event) => {
      const button = event.target instanceof Element ? event.target.closest("button") : null;
      if (!button) return;
      const action = Object.keys(actions).find((selector) => button.matches(selector));
      if (action) actions[action]();
      else if (button.dataset.definition) this.open(button.dataset.definition);
    });
  }

  #forget() {
    this.edits.drop(this.key);
    this.refresh();
  }

  #goToProblem() {
    const { definition = "", line = "0" } = one(this.element, ".result-place", HTMLElement).dataset;
    if (definition !== this.key) this.open(definition);
    this.#editor?.mark(Number(line));
    this.#editor?.goTo(Number(line));
  }
}
