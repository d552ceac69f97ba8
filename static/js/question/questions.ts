/**
 * Questions and predictions: an answer is judged at once and explained. Most kinds work without
 * Python. A question can be answered again; a prediction is made once, or its answer revealed.
 */

import { errorText } from "../errors.ts";
import { findAll, element, findOptional, find, closestTo } from "../page/dom.ts";
import { onOtherTabChange, loadItem, saveItem } from "../page/storage.ts";
import { words } from "../page/words.ts";
import { KINDS } from "./book_kinds.js";
import { installDrafts, restoreDrafts } from "./drafts.ts";
import { showProgress } from "./progress.ts";
import {
  forms,
  type Answer,
  isPrediction,
  type Option,
  type Question,
  questionOf,
  type Content,
  type Verdict,
} from "./question.ts";

export { leavePage } from "./drafts.ts";

/** Null: the answer was revealed without a guess. */
type AnswerOrNone = Answer | null;

/** Listen on any page, now and after a change of chapter. */
export function install() {
  document.addEventListener("submit", (event) => {
    const form = closestTo(event, "form:is([data-quiz], [data-predict])", HTMLFormElement);
    if (!form) return;
    event.preventDefault();
    setAnnounced(form, true);
    submit(form);
  });
  document.addEventListener("click", (event) => {
    const form = revealedForm(event);
    if (form) {
      setAnnounced(form, true);
      acceptAnswer(form, null);
    }
    scrollToQuestion(event);
  });
  document.addEventListener("answers-forgotten", forget);
  document.addEventListener("answers-read", restoreAll);
  onOtherTabChange((key) => {
    for (const form of forms()) if (key === null || key === keyOf(form)) restore(form);
    showProgress();
  });
  addEventListener("pageshow", ({ persisted }) => {
    if (!persisted) return; // else other pages may have been read meanwhile
    for (const form of forms()) if (loadItem(keyOf(form))) restore(form);
    showProgress();
  });
  for (const kind of new Set(Object.values(KINDS))) kind.install?.();
  installDrafts();
}

/** Put each question of the page in the reader's order, with the answer of an earlier visit. */
export function setUpPage() {
  for (const form of forms()) setUp(form);
  restoreDrafts();
  showProgress();
}

/** Name of the stored answer. */
function keyOf(form: HTMLFormElement) {
  return isPrediction(form) ? `predict:${form.dataset.predict}` : `quiz:${form.dataset.quiz}`;
}

function setUp(form: HTMLFormElement) {
  const question = questionOf(form);
  const kind = KINDS[question.kind];
  kind.prepare?.(form, question);
  const given = storedAnswer(form, question);
  if (given !== undefined && given !== null) kind.put?.(form, given);
  setAnnounced(form, false);
  show(form, question, given);
}

/** Announce feedback to a new answer, and not where it is shown again. */
function setAnnounced(form: HTMLFormElement, isAsked: boolean) {
  const feedback = find(form, ".feedback", HTMLElement);
  feedback.setAttribute("aria-live", isAsked ? "polite" : "off");
}

/** The stored answer; undefined where there is none to this edition of the question. */
function storedAnswer(form: HTMLFormElement, question: Question): AnswerOrNone | undefined {
  const entry = loadItem(keyOf(form));
  if (entry?.edition !== question.edition) return undefined;
  const given = isPrediction(form) ? entry.guess : entry.answer;
  const isAsked = given === null && isPrediction(form);
  return isAsked || KINDS[question.kind].fits(question, given) ? given : undefined;
}

/** The first answer that was stored to this edition of the question. */
function firstAnswer(form: HTMLFormElement, { edition }: Question): AnswerOrNone | undefined {
  const entry = loadItem(keyOf(form));
  return entry?.edition === edition ? (entry.first ?? entry.answer) : undefined;
}

/** Show what was answered elsewhere meanwhile. */
function restore(form: HTMLFormElement) {
  form.reset();
  setUp(form);
}

function restoreAll() {
  for (const form of forms()) restore(form);
  showProgress();
}

/** Forget the answers of this page. */
function forget() {
  for (const form of forms()) saveItem(keyOf(form), null);
  restoreAll();
}

/** Judge the form's answer: at once, but for the kind that needs Python. */
function submit(form: HTMLFormElement) {
  const question = questionOf(form);
  const given = KINDS[question.kind].read(form, question);
  if (given instanceof Promise) {
    given.then((late) => acceptAnswer(form, late)).catch((error) => showFailure(form, error));
  } else if (given !== null) {
    acceptAnswer(form, given);
  } else {
    show(form, question, undefined);
    showMessage(form, KINDS[question.kind].missing?.(question) ?? "");
    showProgress();
  }
}

function acceptAnswer(form: HTMLFormElement, given: AnswerOrNone) {
  const question = questionOf(form);
  show(form, question, given);
  const { edition } = question;
  const right = form.dataset.answered === "correct";
  const entry = isPrediction(form)
    ? { edition, guess: given }
    : { edition, answer: given, right, first: firstAnswer(form, question) ?? given };
  saveItem(keyOf(form), entry);
  showProgress();
}

function showFailure(form: HTMLFormElement, error: unknown) {
  show(form, questionOf(form), undefined);
  const byReader = error instanceof DOMException && error.name === "AbortError";
  if (!byReader) showMessage(form, words("question.no_judge", { reason: errorText(error) }));
  showProgress();
}

/** Instead of a verdict. */
function showMessage(form: HTMLFormElement, text: string) {
  find(form, ".feedback", HTMLElement).replaceChildren(element("p", "", text));
}

/** The verdict on an answer, or none. */
function show(form: HTMLFormElement, question: Question, given: AnswerOrNone | undefined) {
  const kind = KINDS[question.kind];
  const feedback = find(form, ".feedback", HTMLElement);
  if (isPrediction(form)) {
    const isMade = given !== undefined;
    find(form, "fieldset", HTMLFieldSetElement).disabled = isMade;
    for (const answer of answersTo(form)) answer.toggleAttribute("data-open", isMade);
    toggleLinks(form, isMade);
  }
  if (given === undefined) {
    delete form.dataset.answered;
    feedback.replaceChildren();
  } else {
    const verdict = given === null ? withoutGuess(question) : kind.judge(question, given);
    form.dataset.answered = given === null ? "revealed" : verdict.right ? "correct" : "wrong";
    const compared = isPrediction(form) ? kind.compare?.(form, question, given) : undefined;
    const beside = compared ? [sideBySide(...compared)] : [];
    const whole = element("div");
    whole.ariaAtomic = "true"; // it comes as one and is announced as one, in its order
    whole.append(...beside, ...verdictElements(verdict, isPrediction(form)));
    feedback.replaceChildren(whole);
  }
  kind.mark?.(form, question, given ?? null);
}

function withoutGuess({ options }: Question): Verdict {
  const replies = options.filter(({ correct }) => correct);
  return { right: false, words: words("predict.without"), replies };
}

function verdictElements({ right, words: specific, replies, remark }: Verdict, isGuess: boolean) {
  const [yes, no] = isGuess
    ? ["predict.agrees", "predict.differs"]
    : ["question.right", "question.wrong"];
  const verdict = element("p", "verdict label", specific ?? words(right ? yes : no));
  const last = element("p", "explanation", remark ?? "");
  const reasons = replies.filter((reply) => reply.explanation_html !== "").map(explanation);
  return [verdict, ...reasons, ...(remark ? [last] : [])];
}

function explanation({ correct, explanation_html: html }: Option) {
  const reason = element("div", `explanation ${correct ? "correct" : "wrong"}`);
  reason.innerHTML = html; // from the book's page
  return reason;
}

/** The prediction whose answer this click reveals, without a guess. */
function revealedForm(event: MouseEvent) {
  const button = closestTo(event, "[data-reveal]", HTMLButtonElement);
  const id = button?.dataset.reveal || button?.closest("form")?.dataset.predict;
  return id ? findOptional(document, `form[data-predict="${id}"]`, HTMLFormElement) : null;
}

/** A link to what is still hidden leads to the question before it. */
function scrollToQuestion(event: MouseEvent) {
  const link = closestTo(event, 'a[href^="#"]', HTMLAnchorElement);
  const target = link && document.getElementById(decodeURIComponent(link.hash.slice(1)));
  const answer = target?.parentElement?.closest<HTMLElement>(".answer:not([data-open])");
  if (answer) document.getElementById(`predict-${answer.dataset.answers}`)?.scrollIntoView();
}

/** Links of the question to the experiment are plain words until the guess is made. */
function toggleLinks(form: HTMLFormElement, isMade: boolean) {
  for (const link of findAll(form, ".predict-question a.set", HTMLAnchorElement)) {
    const { held: href } = link.dataset;
    if (isMade && href !== undefined) {
      link.href = href;
      delete link.dataset.held;
    } else if (!isMade && href === undefined) {
      link.dataset.held = link.getAttribute("href") ?? "";
      link.removeAttribute("href");
    }
  }
}

/** What is hidden until this prediction is made. */
function answersTo(form: HTMLFormElement) {
  return findAll(document, `[data-answers="${form.dataset.predict}"]`, HTMLElement);
}

/** The guess, if there is one, and what was computed. */
function sideBySide(guess: Content | null, truth: Content) {
  const list = element("dl", "meeting row");
  if (guess) list.append(group("guessed role-ray", words("predict.your_guess"), guess));
  list.append(group("computed role-image", words("predict.computed"), truth));
  return list;
}

function group(className: string, name: string, shown: Content) {
  const [parts, value] = [element("div", className), element("dd")];
  value.append(...shown);
  parts.append(element("dt", "fine", name), value);
  return parts;
}
