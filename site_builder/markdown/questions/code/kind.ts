/**
 * A function to write: judged in an interpreter of its own, by values first, which decide whether it
 * is right, then by a ladder's workload and by hard cases.
 */

import type { CodeEditor } from "../../../../site_builder/editor/code_editor.ts";
import { drawFigureWith } from "../../../../static/js/editor/feature.ts";
import { loadEditor } from "../../../../static/js/editor/load.ts";
import { printable, errorText } from "../../../../static/js/errors.ts";
import { addPoint, type Ladder, type Result } from "../../../../static/js/ladder/chart.ts";
import {
  findAll,
  data,
  element,
  findOptional,
  find,
  closestTo,
} from "../../../../static/js/page/dom.ts";
import { loadItem, saveItem } from "../../../../static/js/page/storage.ts";
import { messageText, words, type Message } from "../../../../static/js/page/words.ts";
import {
  forms,
  type Kind,
  type Program,
  type Question,
  questionOf,
} from "../../../../static/js/question/question.ts";
import {
  startConfinedWorker,
  Runtime,
  RuntimeFailure,
  sharedRuntime,
} from "../../../../static/js/runtime/runtime.ts";
import { comparisonSentences } from "../../../../static/js/ladder/comparison.ts";

interface Exercise extends Question {
  program: {
    model: string;
    adapter: string;
    ladder: string;
    tier: string;
    hard: { cases?: object };
  };
  starter: string;
  figure: string;
  settings: Record<string, string>;
}

/** As in simulations/editing/exercise.py. */
interface Trial {
  call: string;
  why: string;
  got: string;
  expected: string;
  passed: boolean;
  asked: boolean;
}

/** What a stage finds; `miss` is a `Miss` of simulations/editing/exercise.py. */
interface Found {
  problem?: { message: string | Message; line: number };
  printed: string;
  count: number;
  miss: Miss | null;
  yours: Result;
  tiers: Result[];
  trials: Trial[];
}

interface Miss {
  fault: string;
  call: string;
  got: string;
  expected: string;
  recognised: number;
  pictures: { width: number; height: number; rgb: string }[];
  given: { name: string; value?: string; shape?: string }[];
}

/** Longest time of each stage, in milliseconds. */
const LIMITS = { values: 15_000, workload: 60_000, hard: 5000 };
/** Wrong answers after which the solution is shown. */
const TRIES = 3;

/** Where all exercises of the page are judged, once one is. */
let judge: Runtime | null = null;

export const kind: Kind<Exercise, Program> = {
  install() {
    customElements.define("code-answer", CodeAnswer);
    for (const name of ["answers-forgotten", "answers-read"]) {
      document.addEventListener(name, () => {
        for (const form of exercises()) {
          if (name === "answers-forgotten") answerIn(form).forget();
          else if (answered(form)) saveItem(keyOf(form), null);
          answerIn(form).restore();
        }
      });
    }
  },

  async read(form) {
    return await answerIn(form).check();
  },

  fits: (_question, { code, reply } = {}) => typeof code === "string" && Number.isInteger(reply),

  judge({ options }, { reply }) {
    const right = reply === 0;
    const verdict = words(right ? "question.right" : "question.not_yet");
    return { right, words: verdict, replies: options.slice(reply, reply + 1) };
  },

  mark(form, _question, given) {
    answerIn(form).offerSolution(given?.reply === 0 ? given.code : null);
  },
};

function exercises() {
  return forms().filter((form) => form.dataset.kind === "code");
}

function answerIn(form: HTMLFormElement) {
  return find(form, "code-answer", CodeAnswer);
}

/** The text that was checked last, if any. */
function answered(form: HTMLFormElement): string | undefined {
  return loadItem(`quiz:${form.dataset.quiz}`)?.answer?.code;
}

/** Under which the reader's text is kept. */
function keyOf(form: HTMLFormElement) {
  return `code:${form.dataset.quiz}`;
}

/** Text, editor, results and buttons of one exercise. */
class CodeAnswer extends HTMLElement {
  #editor: CodeEditor | null = null;
  #opened = false;
  /** Texts that were tried and wrong. */
  #tried: Set<string> = new Set();
  /** The text that was found right last, unless another was wrong since: it can be used. */
  #right: string | null = null;
  /** Number of the check under way; results of an earlier one are dropped. */
  #check = 0;

  connectedCallback() {
    const { form, area } = this;
    find(this, ".row", HTMLElement).prepend(find(form, "[type=submit]", HTMLButtonElement)); // near the code, not below all results
    this.restore();
    form.addEventListener("reset", () => queueMicrotask(() => this.restore()));
    area.addEventListener("focus", () => this.#open(), { once: true });
    area.addEventListener("input", () => this.#changed());
    this.addEventListener("click", (event) => this.#press(event));
  }

  /** Show the text that is kept, or what the exercise starts with. */
  restore() {
    const { form } = this;
    this.text = loadItem(keyOf(form))?.text ?? answered(form) ?? this.#question.starter;
  }

  /** What was written and found is gone. */
  forget() {
    saveItem(keyOf(this.form), null);
    this.#tried.clear();
    this.#showMessage("");
    for (const found of findAll(this, ".code-chart, .code-solution", HTMLElement))
      found.hidden = true;
  }

  disconnectedCallback() {
    this.#editor?.destroy();
    if (exercises().length === 0) this.#end();
  }

  get form() {
    return this.closest("form") as HTMLFormElement;
  }

  get area() {
    return find(this, "textarea", HTMLTextAreaElement);
  }

  get text() {
    return this.area.value;
  }

  set text(text: string) {
    this.area.value = text;
    this.#changed();
  }

  get #question() {
    return questionOf(this.form) as Exercise;
  }

  /** Whether the text is right: values decide, and what else is found comes later. */
  async check(): Promise<Program> {
    const check = ++this.#check;
    const code = this.text;
    this.#showMessage(words("exercise.trying"));
    this.#running(true);
    try {
      const found = await this.#judged("values", code);
      if (check !== this.#check) throw stopped();
      const wrong = found.problem || found.miss;
      this.#showValues(found);
      if (wrong) {
        this.#tried.add(code);
        const reply = 1 + (found.miss?.recognised ?? -1);
        return { code, reply: reply || this.#question.options.length };
      }
      this.#goOn(code, check);
      return { code, reply: 0 };
    } catch (error) {
      const byCode = error instanceof RuntimeFailure && ["lost", "python"].includes(error.kind);
      if (check !== this.#check) throw stopped();
      if (!byCode) throw error;
      this.#showMessage(reasonOf(error));
      return { code, reply: this.#question.options.length };
    } finally {
      if (check === this.#check && !this.dataset.stage) this.#running(false);
    }
  }

  /** The further stages, each shown as it ends. */
  async #goOn(code: string, check: number) {
    const { program } = this.#question;
    try {
      for (const stage of ["workload", "hard"] as const) {
        if (!(stage === "hard" ? program.hard.cases : program.ladder)) continue;
        this.dataset.stage = stage;
        const waits = this.#add(words(`exercise.${stage}`));
        const found = await this.#judged(stage, code);
        waits.remove();
        if (check !== this.#check) return;
        if (found.problem) this.#showProblem(found);
        else if (stage === "hard") this.#showTrials(found);
        else this.#showWorkload(found);
      }
    } catch (error) {
      if (check === this.#check) this.#add(reasonOf(error));
    } finally {
      if (check === this.#check) {
        delete this.dataset.stage;
        this.#running(false);
      }
    }
  }

  async #judged(stage: keyof typeof LIMITS, edits: string): Promise<Found> {
    const { program } = this.#question;
    const book = sharedRuntime();
    if (!book || !Runtime.supported) throw new Error(words("figure.does_not_run"));
    judge ??= new Runtime(book.url, () => [], startConfinedWorker);
    const request = { program: JSON.stringify(program), edits, stage, ladder: program.ladder };
    try {
      return (await judge.call("exercise", request, () => 0, LIMITS[stage])) as any;
    } catch (error) {
      if (!(error instanceof RuntimeFailure && error.late)) throw error;
      const said = words("exercise.endless", { seconds: LIMITS[stage] / 1000 });
      throw new RuntimeFailure("lost", said);
    }
  }

  #showValues({ problem, printed, miss, count }: Found) {
    this.#showMessage("");
    if (problem) this.#showProblem({ problem, printed });
    else if (!miss) this.#add(words("exercise.values_right", { count }));
    else this.#showMiss(miss);
    if (printed) this.#results.append(element("pre", "printed", printed));
    this.#editor?.mark(problem?.line ?? 0);
  }

  #showProblem({ problem }: Pick<Found, "problem" | "printed">) {
    if (!problem) return;
    const said = messageText(problem.message);
    const { line } = problem;
    this.#add(line ? words("exercise.problem", { line, said }) : said);
  }

  #showMiss({ fault, call, got, expected, pictures, given }: Miss) {
    this.#add(words(`exercise.${fault}`, { call, got, expected }));
    const told = given.map(({ name, value, shape }) =>
      value === undefined
        ? words("exercise.given_shape", { name, shape: shape ?? "" })
        : words("exercise.given", { name, value }),
    );
    if (told.length > 0) this.#add(told.join(" ")).className = "fine";
    if (pictures.length < 2) return;
    const list = element("div", "code-pictures row");
    for (const [index, { width, height, rgb }] of pictures.entries()) {
      const [place, canvas] = [element("figure"), element("canvas")];
      Object.assign(canvas, { width, height });
      const bytes = Uint8Array.from(atob(rgb), (letter) => letter.charCodeAt(0));
      const pixels = new ImageData(width, height);
      for (let at = 0; at < width * height; at += 1) {
        pixels.data.set([...bytes.subarray(3 * at, 3 * at + 3), 255], 4 * at);
      }
      canvas.getContext("2d")?.putImageData(pixels, 0, 0);
      const name = words(index === 0 ? "exercise.yours" : "exercise.expected");
      place.append(canvas, element("figcaption", "fine", name));
      list.append(place);
    }
    this.#results.append(list);
  }

  #showWorkload({ yours, tiers }: Found) {
    const ladder: Ladder = data(this, "script.ladder-data");
    this.#add(comparisonSentences(yours, tiers, ladder, this.#question.program.tier).join(" "));
    const chart = find(this, ".code-chart", HTMLElement);
    chart.hidden = false;
    const [own, mine] = [find(chart, ".own", SVGElement), find(chart, ".mine", SVGElement)];
    own.replaceChildren();
    for (const tier of tiers) addPoint(own, tier, ladder);
    for (const earlier of mine.children) earlier.classList.add("earlier");
    addPoint(mine, yours, ladder, "ring");
  }

  #showTrials({ trials }: Found) {
    const asked = trials.filter((trial) => trial.asked);
    const failed = asked.filter((trial) => !trial.passed);
    const [count, passed] = [asked.length, asked.length - failed.length];
    if (count) this.#add(words("exercise.hard_passed", { passed, count }));
    if (failed.length === 0) return;
    const name = this.#question.program.model.split(":")[1];
    const valid = trials.some(({ expected }) => /, (True|False)$/.test(expected));
    const said = [
      words("exercise.hard_calls", { name }),
      valid ? words("exercise.hard_valid") : "",
    ];
    this.#add(said.join(" ").trim()).className = "fine";
    const list = element("ul");
    for (const { call, got, expected, why } of failed) {
      list.append(
        element("li", "", printable(words("exercise.hard_case", { call, got, expected, why }))),
      );
    }
    this.#results.append(list);
  }

  /** @param right What is stored, if it is right. */
  offerSolution(right: string | null) {
    const solution = find(this, ".code-solution", HTMLElement);
    solution.hidden &&= right === null && this.#tried.size < TRIES;
    this.#right = right;
    this.#refresh();
  }

  get #results() {
    return find(this, "[data-results]", HTMLElement);
  }

  /** In place of earlier results. */
  #showMessage(text: string) {
    this.#results.replaceChildren(...(text ? [element("p", "", text)] : []));
  }

  #add(text: string) {
    const line = element("p", "", printable(text));
    this.#results.append(line);
    return line;
  }

  #press(event: MouseEvent) {
    const button = closestTo(event, "button", HTMLButtonElement);
    if (!button) return;
    if ("stop" in button.dataset) this.#stop();
    if ("putBack" in button.dataset) this.text = this.#question.starter;
    if ("hint" in button.dataset) this.#showHint(button);
    if ("use" in button.dataset) this.#use();
  }

  #stop() {
    this.#check += 1;
    this.#end();
    delete this.dataset.stage;
    this.#running(false);
    this.#showMessage(words("exercise.ended"));
  }

  #end() {
    judge?.close();
    judge = null;
  }

  #showHint(button: HTMLButtonElement) {
    find(this, ".code-hints", HTMLElement).hidden = false;
    const [next, ...later] = findAll(this, ".code-hints > [hidden]", HTMLElement);
    next.hidden = false;
    button.disabled = later.length === 0;
  }

  async #use() {
    const { program, figure, settings } = this.#question;
    try {
      const text = `${this.text.trimEnd()}\n\n\n${program.adapter}`;
      await drawFigureWith(figure, program.model, text, settings);
    } catch (error) {
      this.#add(errorText(error));
    }
  }

  #running(busy: boolean) {
    find(this, "[data-stop]", HTMLButtonElement).disabled = !busy;
    this.form.toggleAttribute("aria-busy", busy);
  }

  /** The reader is about to write: have an editor, and an interpreter that has all it needs. */
  async #open() {
    if (this.#opened) return;
    this.#opened = true;
    this.#judged("values", this.#question.starter).catch(() => {}); // reported when it is checked
    const Editor = await loadEditor(this.dataset.editor).catch(() => null);
    if (!Editor || !this.isConnected) return;
    const { area } = this;
    const place = element("div", "code-editor");
    const known = `${this.area.value} ${find(this, ".code-hints", HTMLElement).textContent}`;
    const editor = new Editor(place, {
      members: [...known.matchAll(/\bnp\.([\w.]*\w)/g)].map(([, member]) => member),
      hint: area.getAttribute("aria-describedby") ?? "",
      changed: () => {
        if (area.value === editor.text) return;
        area.value = editor.text;
        this.#changed();
      },
      run: () => this.form.requestSubmit(),
    });
    const focused = document.activeElement === area;
    editor.open({ key: "", text: area.value, firstLine: 1, label: area.ariaLabel ?? "" });
    area.before(place);
    area.hidden = true;
    this.#editor = editor;
    if (focused) editor.view.focus();
  }

  #changed() {
    const { starter } = this.#question;
    const { text } = this;
    if (this.#editor && this.#editor.text !== text) this.#editor.replace(text);
    this.#editor?.mark(0);
    const kept = text === starter && !answered(this.form) ? null : { text };
    if (text !== loadItem(keyOf(this.form))?.text) saveItem(keyOf(this.form), kept);
    this.#refresh();
  }

  #refresh() {
    find(this, "[data-put-back]", HTMLButtonElement).disabled =
      this.text === this.#question.starter;
    const use = findOptional(this, "[data-use]", HTMLButtonElement);
    if (use) use.disabled = this.text !== this.#right;
  }
}

/** What a check ends with that the reader has stopped. */
function stopped() {
  return new DOMException(words("exercise.ended"), "AbortError");
}

/** What ended the code. */
function reasonOf(error: unknown) {
  return words("exercise.broke_off", { reason: errorText(error) });
}
