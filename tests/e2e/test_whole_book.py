"""A walk through the whole book by its links to the next page: every chapter has its figures, which
become live in place, and its questions, which judge every answer."""

from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import Reader

pytestmark = pytest.mark.browser

HOLD = """(() => {
  const send = Worker.prototype.postMessage;
  let held = [];
  window.hold = () => {
    Worker.prototype.postMessage = function (...message) { held.push([this, message]); };
  };
  window.release = () => {
    Worker.prototype.postMessage = send;
    for (const [worker, message] of held) worker.postMessage(...message);
    held = [];
  };
  window.hold();
})()"""
"""Hold back messages to the interpreter, so that the page can be examined as it was served."""
ARRIVED = """async () => {
  await document.fonts.ready;
  for (let left = 2; left; left -= 1) await new Promise(requestAnimationFrame);
  window.shifts.length = 0;
}"""
"""Wait for the page and its fonts, which move some lines on a slow connection."""
CATALOGUED = """() => [
  document.querySelector('h1').innerText.trim(),
  [...new Set([...document.querySelectorAll('simulation-figure')]
    .map((one) => one.dataset.simulation))].sort(),
  [...document.querySelectorAll('form.quiz')].map((form) => form.dataset.quiz),
]"""
STILLS = """() => [...document.querySelectorAll('simulation-figure')].map((figure) => ({
  drawings: [...figure.querySelectorAll('svg.overlay')]
    .map((svg) => svg.innerHTML.replaceAll(/(<text data-estimate[^>]*>)[^<]*/g, '$1')),
  readouts: [...figure.querySelectorAll('output')].map((output) => output.textContent),
  values: [...figure.querySelectorAll('.control-value')].map((text) => text.textContent),
  description: figure.querySelector('.description').textContent,
  boxes: [...figure.querySelectorAll('.panel-view')].map((box) => box.offsetHeight),
}))"""
HEAD = """() => [...document.head.querySelectorAll(
    "link:not([rel=stylesheet], [rel=preload], [rel=modulepreload]), meta:not([http-equiv])")]
  .map((part) => `${part.rel ?? part.name} ${part.href ?? part.content}`).sort()"""


def test_each_chapter_is_complete_live_and_grades_its_answers(reader: Reader, book: Any) -> None:
    """Answers are still stored after a reload, and each page has its own head."""
    page, chapters = reader.page, book["chapters"]
    page.add_init_script(HOLD)
    page.emulate_media(reduced_motion="reduce")  # one plays as it comes into view
    reader.open("", live=False)
    assert_alive_in_place(reader)
    heads = []
    for number, chapter in enumerate(chapters):
        address = reader.root + chapter["url"]
        if number:
            page.evaluate("window.hold()")
            page.locator('a[rel="next"]').last.click()
            page.wait_for_function("url => location.href === url", arg=address)
            assert page.evaluate("document.activeElement.id") == "main"
        else:
            reader.open(chapter["url"], live=False)
            page.evaluate("window.stays = true")
        quizzes, scenes = chapter["quizzes"], sorted(chapter["simulations"])
        assert page.evaluate(CATALOGUED) == [chapter["title"], scenes, quizzes]
        assert chapter["title"] in page.title()
        current = page.locator('#contents a[aria-current="page"]').text_content() or ""
        assert chapter["title"] in current
        heads.append(page.evaluate(HEAD))
        assert_alive_in_place(reader)
        assert_answers_are_judged(reader, book, chapter["id"])
    page.evaluate("history.back()")
    page.wait_for_function("title => document.title.includes(title)", arg=chapters[-2]["title"])
    assert page.evaluate("window.stays")
    page.reload()
    assert page.evaluate(HEAD) == heads[-2]
    for name, kept, verdict, explanation in page.evaluate(STORED_ANSWERS):
        assert (kept, verdict) == (True, "correct"), name
        assert explanation, name


def assert_alive_in_place(reader: Reader) -> None:
    """Assert that live figures equal the served ones and that nothing has moved."""
    page = reader.page
    page.evaluate(ARRIVED)
    still = page.evaluate(STILLS)
    page.evaluate("window.release()")
    reader.wait_live()
    assert page.evaluate(STILLS) == still, page.url
    shifts = page.evaluate("window.shifts")
    assert sum(shift["value"] for shift in shifts) < 0.01, f"{page.url} moved: {shifts}"


def assert_answers_are_judged(reader: Reader, book: Any, chapter: str) -> None:
    for quiz in (each for each in book["quizzes"] if each["chapter"] == chapter):
        form = reader.page.locator(f'form.quiz[data-quiz="{quiz["id"]}"]')
        if quiz["kind"] in ("single", "multiple"):
            assert_choices_are_judged(form, quiz)
        elif quiz["kind"] == "number":
            assert_all_numbers_are_judged(form, quiz)
    for item in (each for each in book["predictions"] if each["chapter"] == chapter):
        form = reader.page.locator(f'form[data-predict="{item["id"]}"]')
        assert form.evaluate(GUESS, right_guess(item)) == [0, "correct", 0], item["id"]


def assert_choices_are_judged(form: Locator, quiz: Any) -> None:
    """Each option alone, then the right ones."""
    right = [index for index, option in enumerate(quiz["options"]) if option["correct"]]
    choices = [[index] for index in range(len(quiz["options"]))] + [right]
    answers = form.evaluate(CHOOSE_EACH, choices)
    for chosen, (verdict, explanations) in zip(choices, answers, strict=True):
        assert verdict == ("correct" if chosen == right else "wrong"), quiz["id"]
        assert len(explanations) == len(chosen), quiz["id"]
        assert all(text.strip() for text in explanations), quiz["id"]


def assert_all_numbers_are_judged(form: Locator, quiz: Any) -> None:
    """A right one, known mistakes, and any other: each has its own reply."""
    options = sorted(quiz["options"], key=lambda option: bool(option["correct"]))
    given = [repr(option.get("value", 12345.6789)) for option in options]
    answers = form.evaluate(TYPE_EACH, given)
    verdicts = ["correct" if option["correct"] else "wrong" for option in options]
    assert [verdict for verdict, _ in answers] == verdicts, quiz["id"]
    replies = {reply for _, reply in answers}
    assert len(replies) == len(answers), f"{quiz['id']}: one reply twice"


def right_guess(item: Any) -> str | None:
    """The number or the index of the option; None for a curve, which only the page has."""
    match item["kind"]:
        case "number":
            return repr(next(option["value"] for option in item["options"] if option["correct"]))
        case "choice":
            return str([option["correct"] for option in item["options"]].index(True))
        case _:
            return None


CHOOSE_EACH = """(form, choices) => choices.map((chosen) => {
  for (const box of form.querySelectorAll('input[name="answer"]')) {
    box.checked = chosen.includes(Number(box.value));
  }
  form.requestSubmit();
  const explanations = [...form.querySelectorAll('[role=status] .explanation')];
  return [form.dataset.answered, explanations.map((one) => one.innerText)];
})"""
"""The verdict on each choice, and its explanations."""
TYPE_EACH = """(form, values) => values.map((value) => {
  form.elements.answer.value = value;
  form.requestSubmit();
  return [form.dataset.answered, form.querySelector('.explanation').innerText];
})"""
GUESS = """(form, right) => {
  const answers = [...document.querySelectorAll(`[data-answers="${form.dataset.predict}"]`)];
  const seen = () =>
    answers.filter((answer) => answer.querySelector('.answer-body').checkVisibility()).length;
  const before = seen();
  const guesses = [...form.querySelectorAll('input[name=guess]')];
  if (right === null) {
    const {sketch} = JSON.parse(form.querySelector('script.predict-data').textContent);
    guesses.forEach((slider, index) => {
      slider.value = sketch.truth[index];
      slider.dispatchEvent(new Event('input', {bubbles: true}));
    });
  } else if (guesses[0].type === 'radio') guesses.find(({value}) => value === right).checked = true;
  else guesses[0].value = right;
  form.requestSubmit();
  return [before, form.dataset.answered, answers.length - seen()];
}"""
"""Numbers of answers visible before the guess and hidden after it, and the verdict between them."""
STORED_ANSWERS = """() => [...document.querySelectorAll('form.quiz, form[data-predict]')]
  .filter((form) => form.querySelector('input:not([data-move])') && !form.dataset.figure
    && !form.querySelector('.order-item'))
  .map((form) => [form.id, 'answered' in form.dataset, form.dataset.answered,
    form.querySelector('[role=status]').innerText])"""
