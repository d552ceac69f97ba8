"""Every question takes right and wrong answers, explains both, and remembers."""

from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_every_quiz_judges_right_and_wrong_explains_and_remembers_until_the_next_visit(
    plain_reader: Reader, book: Any
) -> None:
    for quiz, url in _quizzes(book):
        form = _open(plain_reader, quiz, url)
        choices = [[index] for index in range(len(quiz["options"]))] + [_right(quiz)]
        for chosen, (verdict, explanations) in zip(
            choices, form.evaluate(ANSWER_EACH, choices), strict=True
        ):
            assert verdict == ("correct" if chosen == _right(quiz) else "wrong"), quiz["id"]
            assert len(explanations) == len(chosen), quiz["id"]
            assert all(text.strip() for text in explanations), quiz["id"]
    plain_reader.open(live=False)
    for quiz, url in _quizzes(book):
        verdict, checked = _open(plain_reader, quiz, url).evaluate(REMEMBERED)
        assert (verdict, sorted(checked)) == ("correct", _right(quiz)), quiz["id"]


ANSWER_EACH = """(form, choices) => choices.map((chosen) => {
  for (const box of form.querySelectorAll('input[name="answer"]')) {
    box.checked = chosen.includes(Number(box.value));
  }
  form.requestSubmit();
  const told = [...form.querySelectorAll('.feedback .explanation')];
  return [form.dataset.answered, told.map((one) => one.innerText)];
})"""
"""The verdict on each choice, and its explanations. Hands answer in the tests below."""
REMEMBERED = """(form) => [
  form.dataset.answered,
  [...form.querySelectorAll('input[name="answer"]:checked')].map((box) => Number(box.value)),
]"""


def test_a_quiz_is_answered_by_keyboard_alone(plain_reader: Reader, book: Any) -> None:
    quiz, url = _quizzes(book)[0]
    form = _open(plain_reader, quiz, url)
    form.locator("input").first.focus()
    plain_reader.page.keyboard.press("Space")
    plain_reader.page.keyboard.press("Enter")
    assert form.get_attribute("data-answered") in ("correct", "wrong")


def test_checking_without_an_answer_asks_for_one_and_takes_it(
    plain_reader: Reader, book: Any
) -> None:
    form = _open(plain_reader, *_quizzes(book)[0])
    form.locator("button[type=submit]").click()
    assert "Choose" in form.locator(".feedback").inner_text()
    assert form.get_attribute("data-answered") is None
    form.locator("input").first.check()
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") in ("correct", "wrong")


def _quizzes(book: Any) -> list[tuple[Any, str]]:
    urls = {chapter["id"]: chapter["url"] for chapter in book["chapters"]}
    choices = (quiz for quiz in book["quizzes"] if quiz["kind"] in ("single", "multiple"))
    return [(quiz, urls[quiz["chapter"]]) for quiz in choices]


def _right(quiz: Any) -> list[int]:
    return [index for index, option in enumerate(quiz["options"]) if option["correct"]]


def _open(reader: Reader, quiz: Any, url: str) -> Locator:
    if not reader.page.url.endswith(url):
        reader.turn_to(url, live=False)
    return reader.page.locator(f'form.quiz[data-quiz="{quiz["id"]}"]')
