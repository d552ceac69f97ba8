"""Questions that draw their numbers: a class has the same, a reader keeps some or asks for more."""

from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import Reader

pytestmark = pytest.mark.browser


@pytest.fixture
def drawing(book: Any) -> Any:
    """The question with the most combinations."""
    return max(book["quizzes"], key=lambda quiz: len(quiz.get("variants", ())))


@pytest.fixture
def url(book: Any, drawing: Any) -> str:
    return str(next(c["url"] for c in book["chapters"] if c["id"] == drawing["chapter"]))


def test_a_seed_gives_a_class_the_same_numbers_and_stays(
    plain_reader: Reader, drawing: Any, url: str
) -> None:
    seen = []
    for seed in ("spring", "summer", "autumn"):
        plain_reader.open(f"{url}?seed={seed}", live=False)
        seen.append(asked(plain_reader, drawing))
    assert len({*seen}) > 1
    plain_reader.forget()
    plain_reader.open(f"{url}?seed=spring", live=False)
    assert asked(plain_reader, drawing) == seen[0], "in another browser"
    plain_reader.open(live=False)
    plain_reader.turn_to(url, live=False)
    assert asked(plain_reader, drawing) == seen[0], "without the seed in the address"


def test_an_answer_stays_with_its_numbers_until_others_are_asked_for(
    plain_reader: Reader, drawing: Any, url: str
) -> None:
    plain_reader.open(url, live=False)
    form, first = form_of(plain_reader, drawing), asked(plain_reader, drawing)
    others = form.get_by_role("button", name="Other numbers")
    assert others.is_hidden(), "before an answer"
    answer(form, drawing)
    plain_reader.page.reload()
    assert (asked(plain_reader, drawing), verdict(form)) == (first, "correct")
    others.click()
    second = asked(plain_reader, drawing)
    assert form.locator("input[name=answer]").evaluate("field => field === document.activeElement")
    assert (second != first, verdict(form)) == (True, None)
    plain_reader.page.reload()
    assert (asked(plain_reader, drawing), verdict(form)) == (second, None)
    plain_reader.page.evaluate("document.dispatchEvent(new Event('answers-read'))")
    assert (asked(plain_reader, drawing), verdict(form)) == (first, "correct"), "as in a file"
    others.click()
    answer(form, drawing)
    plain_reader.page.reload()
    assert (asked(plain_reader, drawing), verdict(form)) == (second, "correct")
    plain_reader.open(live=False)
    assert "1 of " in plain_reader.page.locator(".progress").inner_text()
    plain_reader.open(f"{url}?seed=", live=False)
    assert asked(plain_reader, drawing) == second, "without a class, the reader's own stay"
    seeds = (f"{url}?seed=class-{number}" for number in range(20))
    for seed in seeds:
        plain_reader.open(seed, live=False)
        if asked(plain_reader, drawing) != second:
            break
    assert verdict(form) is None, "numbers of a class are asked for whatever was answered before"


def form_of(reader: Reader, quiz: Any) -> Locator:
    return reader.page.locator(f'form[data-quiz="{quiz["id"]}"]')


def asked(reader: Reader, quiz: Any) -> str:
    return form_of(reader, quiz).locator(".asked").inner_text()


def verdict(form: Locator) -> str | None:
    return form.get_attribute("data-answered")


def answer(form: Locator, quiz: Any) -> None:
    """With the right number for what is asked."""
    variant = quiz["variants"][int(form.get_attribute("data-variant") or 0)]
    value = next(option["value"] for option in variant["options"] if option["correct"])
    form.locator("input[name=answer]").fill(repr(value))
    form.locator("button[type=submit]").click()
    assert verdict(form) == "correct"
