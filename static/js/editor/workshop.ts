/**
 * The Python of one figure, to be read, changed, run and put back. Edited code runs in a separate
 * interpreter and draws the figure only once it has drawn a frame.
 */

import { errorText } from "../errors.ts";
import type { LiveFigure } from "../figure/live.ts";
import { download, find } from "../page/dom.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import { RuntimeFailure, type Runtime } from "../runtime/runtime.ts";
import { EditFailure, EditedRuntime, type Problem } from "./edited_runtime.ts";
import { Edits } from "./edits.ts";
import { loadEditor, loadPanel } from "./load.ts";
import { Panel } from "./panel.ts";
import { fetchSources, firstPart, nameOf } from "./sources.ts";

export class Workshop {
  #panel: Panel | null = null;
  #edits: Promise<Edits> | null = null;
  #opening = false;
  #running = false;
  /** The edits that draw the figure, as JSON. */
  #ran = "";
  /** Counts the frames by edited code. */
  #trial = 0;
  #showStages = () => this.#panel?.showStages(this.live?.stages ?? []);

  readonly scene: string;
  readonly button: HTMLButtonElement;
  readonly state: HTMLElement;
  readonly edited: EditedRuntime;

  /**
   * @param live Null where this browser runs no Python.
   * @param book What draws the figure by the book's code.
   * @param name Key of the edits in storage.
   */
  constructor(
    readonly figure: HTMLElement,
    readonly live: LiveFigure | null,
    readonly book: Runtime,
    readonly name: string,
  ) {
    this.scene = figure.dataset.simulation ?? "";
    this.button = find(figure, ".open-python", HTMLButtonElement);
    this.state = find(figure, ".python-state", HTMLElement);
    this.edited = new EditedRuntime(book, {
      drawn: (printed) => this.#showDrawn(printed),
      failed: (failure) => this.#showFailure(failure),
      stopped: (reason) => this.#showStopped(reason),
    });
  }

  /** Open what is closed, close what is open. */
  async toggle() {
    if (this.#panel) {
      this.#close();
      return;
    }
    if (this.#opening) return;
    this.#opening = true;
    try {
      await this.#open();
    } catch (error) {
      setText(this.state, words("workshop.not_fetched", { reason: errorText(error) }));
    } finally {
      this.#opening = false;
    }
  }

  /** Run what ran when the reader left, once the figure has its first frame. */
  async resume() {
    if (this.figure.dataset.state !== "live") {
      await new Promise((resolve) => {
        this.figure.addEventListener("painted", resolve, { once: true });
      });
    }
    const edits = await this.#loadEdits();
    if (edits.currentKeys.length > 0) await this.#run();
    else this.#showState(edits);
  }

  /** Run `text` in place of a definition of the book's. */
  async runWith(key: string, text: string) {
    const edits = await this.#loadEdits();
    if (!(key in edits.sources.definitions)) throw new Error(words("workshop.unused"));
    edits.set(key, text.trimEnd());
    this.#panel?.open(key);
    await this.#run();
  }

  leave() {
    this.#trial += 1;
    this.figure.removeEventListener("painted", this.#showStages);
    this.#panel?.leave();
    this.#panel = null;
    this.edited.close();
  }

  /** The reader's edits, and the sources that they were made of. */
  #loadEdits() {
    this.#edits ??= fetchSources(this.scene).then(
      (sources) => new Edits(this.name, sources),
      (error) => {
        this.#edits = null;
        throw error;
      },
    );
    return this.#edits;
  }

  async #open() {
    const [edits, element, Editor] = await Promise.all([
      this.#loadEdits(),
      loadPanel(),
      this.live ? loadEditor(this.button.dataset.editor) : null,
    ]);
    const panel = new Panel(element, this.button.id, edits.sources, edits, {
      changed: () => this.#changed(edits),
      run: () => this.#run(),
      stop: () => this.#stop(edits),
      putBack: () => this.#putBack(edits),
      putAllBack: () => this.#putAllBack(edits),
      download: () => this.#download(edits),
      close: () => this.#close(),
    });
    if (Editor) panel.edit(Editor);
    else panel.showReadOnly(words(this.live ? "workshop.no_editor" : "workshop.no_python"));
    element.id = this.button.getAttribute("aria-controls") ?? "";
    find(this.figure, ".python", HTMLElement).append(element);
    this.#panel = panel;
    panel.open(firstPart(edits.sources, this.live?.stages ?? []));
    this.#showStages();
    this.#showState(edits);
    this.figure.addEventListener("painted", this.#showStages);
    this.button.setAttribute("aria-expanded", "true");
    panel.focus();
  }

  #close() {
    this.figure.removeEventListener("painted", this.#showStages);
    this.#panel?.leave();
    this.#panel = null;
    this.button.setAttribute("aria-expanded", "false");
    this.button.focus();
  }

  #changed(edits: Edits) {
    if (!this.#panel || !this.live) return;
    edits.set(this.#panel.key, this.#panel.text);
    this.#panel.refresh();
    this.#showState(edits);
    this.edited.warm(this.live.request()).catch(() => {}); // reported when it is run
  }

  async #run() {
    if (this.#running || !this.live) return;
    const edits = await this.#loadEdits();
    const { json } = edits;
    if (edits.currentKeys.length === 0) {
      this.#returnToBook(edits);
      return;
    }
    this.#running = true;
    this.#showState(edits);
    this.#report(words("workshop.running"));
    edits.setRuns(false); // until it is known to end
    try {
      const request = this.live.request();
      this.edited.adopt(json, request, await this.edited.draw(request, json));
      this.#ran = json;
      this.live.drawnBy(this.edited);
    } catch (error) {
      if (this.#running) this.#showFailure(error); // else the reader stopped it
    } finally {
      this.#running = false;
      this.#showState(edits);
    }
  }

  /** End the reader's code, which can be run again; the book's draws the figure. */
  #stop(edits: Edits) {
    if (!this.#running && !this.#isEdited) return;
    this.#running = false;
    this.#returnToBook(edits, words("workshop.ended"));
  }

  #putBack(edits: Edits) {
    if (this.#running || !this.#panel) return;
    edits.remove(this.#panel.key);
    this.#panel.putBack();
    if (this.#isEdited) this.#run();
    else this.#report("");
  }

  #putAllBack(edits: Edits) {
    if (this.#running) return;
    edits.remove();
    this.#panel?.putBack();
    this.#returnToBook(edits);
  }

  #returnToBook(edits: Edits, text = words("workshop.book")) {
    edits.setRuns(false);
    this.edited.close();
    this.live?.drawnBy(this.book);
    this.#panel?.print("");
    this.#panel?.refresh();
    this.#report(text);
    this.#showState(edits);
  }

  #download(edits: Edits) {
    const texts = [...edits.entries].map(([key, { text }]) => {
      const module = key.slice(0, key.indexOf(":"));
      return `# ${nameOf(key)} in ${module.replaceAll(".", "/")}.py\n\n${text}\n`;
    });
    download(`${this.scene}-edited.py`, texts.join("\n\n"), "text/x-python");
  }

  /** Whether the figure is drawn by the reader's code. */
  get #isEdited() {
    return this.live?.runtime === this.edited;
  }

  async #showDrawn(printed: string) {
    this.#panel?.print(printed);
    this.#report(words("workshop.runs"));
    const edits = await this.#loadEdits();
    this.#showState(edits);
    await this.#confirm(edits);
  }

  /**
   * Store that the code runs, once the page has answered for some seconds after its last frame: a
   * drawing that freezes the page must not come back with each visit.
   */
  async #confirm(edits: Edits) {
    const trial = ++this.#trial;
    edits.setRuns(false);
    for (let steps = 0; steps < TRIAL.steps && trial === this.#trial; ) {
      const begun = performance.now();
      await new Promise((resolve) => setTimeout(resolve, TRIAL.stepMs));
      steps = performance.now() - begun < TRIAL.pauseMs ? steps + 1 : 0;
    }
    const isSame = trial === this.#trial && this.#isEdited && edits.json === this.#ran;
    if (isSame) edits.setRuns(true);
  }

  /** Edited code did not end while the reader used the figure: the book's draws it again. */
  async #showStopped(reason: string) {
    this.live?.drawnBy(this.book);
    const edits = await this.#loadEdits();
    edits.setRuns(false);
    this.#showState(edits);
    this.#report(words("workshop.stopped", { reason }), problemWithoutLine(reason));
  }

  #showFailure(error: unknown) {
    if (error instanceof EditFailure) {
      this.#panel?.print(error.printed);
      this.#report(error.message, error.problem);
      return;
    }
    const lost = error instanceof RuntimeFailure && error.kind === "lost";
    const reason = errorText(error);
    const text = words(lost ? "workshop.stopped_first" : "workshop.did_not_run", { reason });
    this.#report(text, problemWithoutLine(reason));
  }

  #report(text: string, problem?: Problem) {
    this.#panel?.report(text, problem);
    if (!this.#panel && problem) setText(this.state, text);
  }

  /** Show the state of the code, also where the panel is closed, and which buttons can be pressed. */
  #showState(edits: Edits) {
    this.figure.toggleAttribute("data-edited", this.#isEdited);
    const changed = edits.entries.size > 0 ? words("workshop.changed") : "";
    setText(this.state, this.#isEdited ? words("workshop.mark") : changed);
    this.#panel?.showRunning(this.#running, this.#isEdited);
  }
}

/** A problem that no line is known for. */
function problemWithoutLine(text: string): Problem {
  return { message: text, definition: "", line: 0 };
}

/** Steps in which the page must answer before code counts as running; a longer pause begins anew. */
const TRIAL = { steps: 12, stepMs: 250, pauseMs: 1000 };
