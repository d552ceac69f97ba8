/** The workshop in the page: the parts of a figure's Python, an editor, and the result of a run. */

import type { CodeEditor } from "../../../site_builder/editor/code_editor.ts";
import { reasonText, type Stage } from "../figure/stage_report.ts";
import { findAll, find } from "../page/dom.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import type { Problem } from "./edited_runtime.ts";
import type { Edits } from "./edits.ts";
import { nameOf, type Sources } from "./sources.ts";

/** Callbacks of the reader's actions. */
type Actions = Record<
  "changed" | "run" | "stop" | "putBack" | "putAllBack" | "download" | "close",
  () => void
>;

export class Panel {
  #editor: CodeEditor | null = null;
  /** Key of the definition that is shown. */
  key = "";

  readonly hint: HTMLElement;

  /** @param id Begins the ids of its parts. */
  constructor(
    readonly element: HTMLElement,
    id: string,
    readonly sources: Sources,
    readonly edits: Edits,
    readonly actions: Actions,
  ) {
    this.hint = this.#part(".workshop-hint");
    this.hint.id = `${id}-hint`;
    this.#listParts();
    element.addEventListener("click", (event) => this.#press(event));
  }

  /** The text in the editor. */
  get text() {
    return this.#editor?.text ?? "";
  }

  /** Let the reader write, with this editor. */
  edit(Editor: typeof CodeEditor) {
    const { changed, run } = this.actions;
    this.#editor = new Editor(this.#part(".workshop-code"), { hint: this.hint.id, changed, run });
  }

  /** Let the reader only read. */
  showReadOnly(why: string) {
    const listing = document.createElement("pre");
    listing.tabIndex = 0;
    listing.className = "code";
    this.#part(".workshop-code").append(listing);
    this.hint.textContent = why;
    this.element.classList.add("read-only");
  }

  /** Focus goes to the parts, which come to stand right below the picture. */
  focus() {
    this.element.querySelector("button")?.focus({ preventScroll: true });
    this.element.scrollIntoView();
  }

  leave() {
    this.#editor?.destroy();
    this.element.remove();
  }

  /** Show a definition: the reader's text if there is one, else the book's. */
  open(key: string) {
    const { path, line, text: original, uses } = this.sources.definitions[key];
    const name = nameOf(key);
    const text = this.edits.text(key) ?? original;
    const label = words("workshop.in_file", { name, file: path });
    this.key = key;
    if (this.#editor) this.#editor.open({ key, text, firstLine: line, label });
    else this.#part(".workshop-code > pre").textContent = text;
    setText(this.#part(".place-name"), name);
    setText(this.#part(".path"), path);
    setText(this.#part(".place-line"), String(line));
    this.#listUses(uses);
    this.refresh();
  }

  /** Show the book's text again, as a step that can be undone. */
  putBack() {
    this.#editor?.replace(this.sources.definitions[this.key].text);
  }

  /** Update what depends on which texts are edited. */
  refresh() {
    const { edits, key } = this;
    const edited = edits.text(key) !== null;
    const none = edits.entries.size === 0;
    this.#part(".place-edited").hidden = !edited;
    this.#part(".workshop-offer").hidden = edited || !edits.entries.has(key);
    for (const [name, disabled] of [
      [".put-back", !edited],
      [".put-all-back", none],
      [".download", none],
    ]) {
      this.#part(String(name)).toggleAttribute("disabled", Boolean(disabled));
    }
    for (const part of this.#parts) {
      const { definition = "" } = part.dataset;
      part.toggleAttribute("data-edited", edits.text(definition) !== null);
      part.ariaCurrent = definition === key ? "true" : null;
    }
  }

  /** Show whether each stage of the frame was computed. */
  showStages(stages: Stage[]) {
    for (const part of this.#parts) {
      const stage = stages.find(({ name }) => name === part.dataset.stage);
      const draws = part.dataset.definition === this.sources.draw;
      const status = stage?.status ?? (draws ? "computed" : "");
      part.dataset.status = status;
      part.title = reasonText(stage?.reason ?? "");
      setText(part.querySelector(".part-status"), status && words(`stage_report.${status}`));
    }
  }

  /** The result of a run. */
  report(text: string, problem?: Problem) {
    const place = this.#part(".result-place");
    const { definition = "", line = 0 } = problem ?? {};
    const known = this.sources.definitions[definition];
    this.#part(".workshop-result").classList.toggle("failed", !!problem);
    setText(this.#part(".result-words"), text);
    place.hidden = !known || line === 0;
    Object.assign(place.dataset, { problem: definition, line });
    const where = { line: line + (known?.line ?? 0) - 1, name: nameOf(definition) };
    if (known) setText(place, words("workshop.line", where));
    this.#editor?.mark(definition === this.key ? line : 0);
  }

  print(printed: string) {
    const box = this.#part(".workshop-printed");
    box.hidden = !printed;
    setText(box, printed);
  }

  /**
   * @param busy Whether a run has not ended: nothing can be run or put back meanwhile.
   * @param drawn Whether the reader's code draws the figure: it can be stopped then, too.
   */
  showRunning(busy: boolean, drawn: boolean) {
    for (const button of findAll(
      this.element,
      ".run, .put-back, .put-all-back",
      HTMLButtonElement,
    )) {
      button.ariaDisabled = String(busy);
    }
    this.#part(".stop").ariaDisabled = String(!busy && !drawn);
  }

  get #parts() {
    return findAll(this.element, ".workshop-part", HTMLButtonElement);
  }

  #part(selector: string) {
    return find(this.element, selector, HTMLElement);
  }

  #listParts() {
    const [model] = this.#parts;
    const { formula, stages, draw } = this.sources;
    const parts = [
      { name: words("workshop.formula"), definition: formula, stage: "" },
      ...stages.map((stage) => ({ ...stage, stage: stage.name })),
      { name: words("workshop.drawing"), definition: draw, stage: "" },
    ];
    const items = parts
      .filter(({ definition }) => definition)
      .map(({ name, definition, stage }) => {
        const [item, button] = [document.createElement("li"), copyOf(model)];
        Object.assign(button.dataset, { definition, stage });
        setText(button.querySelector(".part-name"), name);
        item.append(button);
        return item;
      });
    this.#part(".workshop-parts").replaceChildren(...items);
  }

  #listUses(uses: string[]) {
    const list = this.#part(".uses-list");
    const model = find(list, ".use", HTMLButtonElement);
    const buttons = (uses.length > 0 ? uses : [""]).map((key) => {
      const button = copyOf(model);
      button.dataset.definition = key;
      button.textContent = nameOf(key);
      return button;
    });
    list.replaceChildren(...buttons);
    this.#part(".workshop-uses").hidden = uses.length === 0;
  }

  #press(event: MouseEvent) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    const actions: Record<string, () => void> = {
      ".run": this.actions.run,
      ".stop": this.actions.stop,
      ".put-back": this.actions.putBack,
      ".put-all-back": this.actions.putAllBack,
      ".download": this.actions.download,
      ".close": this.actions.close,
      ".offer-show": () => this.#editor?.replace(this.edits.entries.get(this.key)?.text ?? ""),
      ".offer-forget": () => {
        this.edits.remove(this.key);
        this.refresh();
      },
      ".result-place": () => this.#goToProblem(),
      "[data-definition]": () => this.open(button?.dataset.definition ?? ""),
    };
    const action = Object.keys(actions).find((selector) => button?.matches(selector));
    if (action) actions[action]();
  }

  #goToProblem() {
    const { problem = "", line = "0" } = this.#part(".result-place").dataset;
    if (problem !== this.key) this.open(problem);
    this.#editor?.mark(Number(line));
    this.#editor?.goTo(Number(line));
  }
}

function copyOf(button: HTMLButtonElement): HTMLButtonElement {
  return button.cloneNode(true) as HTMLButtonElement;
}
