"""Every question and prediction takes right and wrong answers, explains both, and remembers."""

from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_every_question_and_prediction_judges_each_answer_and_remembers_until_the_next_visit(
    plain_reader: Reader, book: Any
) -> None:
    page, chapters = plain_reader.page, book["chapters"]
    urls = [chapter["url"] for chapter in chapters]
    for chapter, _ in zip(chapters, plain_reader.leaf_through(urls), strict=True):
        for quiz in (each for each in book["quizzes"] if each["chapter"] == chapter["id"]):
            if quiz["kind"] in ("single", "multiple"):
                assert_choices_are_judged(_form(plain_reader, quiz), quiz)
            elif quiz["kind"] == "number":
                assert_all_numbers_are_judged(_form(plain_reader, quiz), quiz)
        for item in (each for each in book["predictions"] if each["chapter"] == chapter["id"]):
            form = page.locator(f'form[data-predict="{item["id"]}"]')
            told = form.evaluate(GUESS, right_guess(item))
            assert told == [0, "correct", 0], item["id"]
    plain_reader.open(live=False)
    plain_reader.turn_to(urls[-2], live=False)
    for name, kept, verdict, said in page.evaluate(KEPT):
        assert (kept, verdict) == (True, "correct"), name
        assert said, name


def assert_choices_are_judged(form: Locator, quiz: Any) -> None:
    """Each option alone, then the right ones."""
    choices = [[index] for index in range(len(quiz["options"]))] + [_right(quiz)]
    for chosen, (verdict, explanations) in zip(
        choices, form.evaluate(CHOOSE_EACH, choices), strict=True
    ):
        assert verdict == ("correct" if chosen == _right(quiz) else "wrong"), quiz["id"]
        assert len(explanations) == len(chosen), quiz["id"]
        assert all(text.strip() for text in explanations), quiz["id"]


def assert_all_numbers_are_judged(form: Locator, quiz: Any) -> None:
    """With each combination that a question draws."""
    variants = quiz.get("variants", [quiz])
    for number in range(len(variants)):
        if number:
            form.evaluate("form => form.querySelector('[data-draw]').click()")
        asked = variants[int(form.get_attribute("data-variant") or 0)]
        assert_numbers_are_judged(form, {**quiz, **asked})


def assert_numbers_are_judged(form: Locator, quiz: Any) -> None:
    """A right one, known mistakes, and any other: each has a reply of its own."""
    options = sorted(quiz["options"], key=lambda option: bool(option["correct"]))
    told = form.evaluate(TYPE_EACH, [repr(option.get("value", 12345.6789)) for option in options])
    verdicts = ["correct" if option["correct"] else "wrong" for option in options]
    assert [verdict for verdict, _ in told] == verdicts, quiz["id"]
    assert len({reply for _, reply in told}) == len(told), f"{quiz['id']}: one reply twice"


def right_guess(item: Any) -> str | None:
    """The number or the place of the option; of a curve only the page knows."""
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
  const told = [...form.querySelectorAll('[role=status] .explanation')];
  return [form.dataset.answered, told.map((one) => one.innerText)];
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
"""Answers that are seen before the guess, the verdict, and answers that are not seen after it."""
KEPT = """() => [...document.querySelectorAll('form.quiz, form[data-predict]')]
  .filter((form) => form.querySelector('input:not([data-move])') && !form.dataset.figure
    && !form.querySelector('.order-item'))
  .map((form) => [form.id, 'answered' in form.dataset, form.dataset.answered,
    form.querySelector('[role=status]').innerText])"""


def _form(reader: Reader, quiz: Any) -> Locator:
    return reader.page.locator(f'form.quiz[data-quiz="{quiz["id"]}"]')


def _right(quiz: Any) -> list[int]:
    return [index for index, option in enumerate(quiz["options"]) if option["correct"]]
