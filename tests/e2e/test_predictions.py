"""A guess is made first and the answer met after it, whatever is guessed and by whichever hand."""

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_a_wrong_number_stands_beside_the_computed_one_until_it_is_taken_back(
    plain_reader: Reader, book: Any
) -> None:
    form = opened(plain_reader, book, "corner-of-a-barrel")
    form.locator("input[name=guess]").fill("40")
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") == "wrong"
    assert form.locator(".guessed dd").inner_text() == "40 px"
    assert form.locator(".computed dd").inner_text().replace("\u00a0", " ") == "\u221240.0 px"
    assert "inwards" in form.locator(".explanation").inner_text()
    plain_reader.page.locator("[data-progress-reset]").click()
    assert form.get_attribute("data-answered") is None
    assert form.locator("input[name=guess]").is_enabled()
    answer = plain_reader.page.locator('[data-answers="corner-of-a-barrel"]')
    assert not answer.locator(".answer-body").is_visible()
    form.locator("input[name=guess]").fill("0")
    form.locator("button[type=submit]").click()
    assert form.locator(".explanation").count() == 0, "not taken for the mistake of −0.2"
    plain_reader.page.locator("[data-progress-reset]").click()
    answer.locator("[data-reveal]").click()
    assert answer.locator(".answer-body").is_visible(), "it is shown from where it waits"
    assert form.get_attribute("data-answered") == "revealed"


def test_a_wrong_choice_is_answered_and_the_right_one_shown_until_it_is_taken_back(
    plain_reader: Reader, book: Any
) -> None:
    form = opened(plain_reader, book, "sharp-again")
    form.locator('input[name=guess][value="0"]').check()
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") == "wrong"
    assert form.locator(".computed dd").inner_text() == "Softer near the border"
    assert form.locator(".explanation").count() == 2
    marks = form.locator("label:is(.correct, .wrong)")
    assert marks.count() == 2
    plain_reader.page.locator("[data-progress-reset]").click()
    assert marks.count() == 0


def test_the_answer_can_be_asked_for_without_a_guess(plain_reader: Reader, book: Any) -> None:
    form = opened(plain_reader, book, "corner-of-a-barrel")
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") is None, "nothing was guessed"
    form.locator("[data-reveal]").focus()
    plain_reader.page.keyboard.press("Enter")
    assert form.get_attribute("data-answered") == "revealed"
    assert form.locator(".guessed").count() == 0
    told = form.locator("[role=status]")
    assert told.get_attribute("aria-live") == "polite", "asked for, it is announced"
    assert told.locator("> *").count() == 1, "as one"
    plain_reader.page.reload()
    assert form.get_attribute("data-answered") == "revealed"
    assert told.get_attribute("aria-live") == "off", "shown again, it is not"


def test_links_to_the_experiment_wait_for_the_guess(plain_reader: Reader, book: Any) -> None:
    form = opened(plain_reader, book, "brightest-point")
    links = form.locator(".predict-question a.set")
    expect(links).to_have_count(2)
    expect(links.and_(plain_reader.page.locator("[href]"))).to_have_count(0)
    form.locator("[data-reveal]").click()
    expect(links.and_(plain_reader.page.locator("[href*='light_angle']"))).to_have_count(2)
    plain_reader.page.locator("[data-progress-reset]").click()
    expect(links.and_(plain_reader.page.locator("[href]"))).to_have_count(0)


def test_a_link_to_what_waits_leads_to_its_question(plain_reader: Reader) -> None:
    plain_reader.open("speed-and-accuracy/", live=False)
    link = plain_reader.page.locator('.table-wrapper a[href="#ladder-inverse-strong"]')
    link.evaluate("link => { link.closest('details').open = true; }")
    link.click()
    expect(
        plain_reader.page.locator("#predict-where-iteration-fails button").first
    ).to_be_in_viewport()


def test_a_sketch_is_drawn_by_pointer_and_meets_the_true_curve_on_its_own_axes(
    plain_reader: Reader, book: Any
) -> None:
    form = opened(plain_reader, book, "frequency-shown")
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") is None, "nothing was drawn"
    assert not form.locator(".truth").is_visible()
    svg = form.locator("svg")
    box = plain_reader.bring(svg)
    mouse, scale = plain_reader.page.mouse, box["width"] / 400
    mouse.move(box["x"] + 52 * scale, box["y"] + 206 * scale)
    mouse.down()
    mouse.move(box["x"] + 384 * scale, box["y"] + 32 * scale, steps=20)
    mouse.up()
    drawn = [float(i.input_value()) for i in form.locator("input[name=guess]").all()]
    assert drawn == pytest.approx([1.2 * i / 8 for i in range(9)], abs=0.04)
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") == "wrong", "it was drawn without a fold"
    assert form.locator(".truth").is_visible()
    assert "differ most" in form.locator(".feedback").inner_text()


def test_a_sketch_is_made_by_arrow_keys_alone(plain_reader: Reader, book: Any) -> None:
    form = opened(plain_reader, book, "brightness-by-angle")
    first = form.locator("input[name=guess]").first
    first.focus()
    plain_reader.page.keyboard.press("End")
    for press in ("Tab", "ArrowUp", "Tab", "ArrowDown", "Tab", "Tab", "ArrowUp"):
        plain_reader.page.keyboard.press(press)
    values = [float(i.input_value()) for i in form.locator("input[name=guess]").all()]
    assert values == pytest.approx([1, 0.51, 0.49, 0.5, 0.51, 0.5, 0.5, 0.5, 0.5])
    assert form.locator("circle.focused").count() == 1
    form.locator("button[type=submit]").press("Enter")
    assert form.get_attribute("data-answered") == "wrong"
    numbers = re.findall(r"\d[\w.]*\b", form.locator(".feedback").inner_text())
    assert numbers == ["90", "0.51", "0"], "the cosine of 90° is no more than rounding away from 0"


def form_of(reader: Reader, item: Any) -> Locator:
    return reader.page.locator(f'form[data-predict="{item["id"]}"]')


def opened(reader: Reader, book: Any, identity: str) -> Locator:
    item = next(item for item in book["predictions"] if item["id"] == identity)
    url = next(c["url"] for c in book["chapters"] if c["id"] == item["chapter"])
    reader.open(url, live=False)
    return form_of(reader, item)
