"""Numbers, orders and figures are judged, by mouse and by keyboard; progress is kept, lost and
carried from one browser to another."""

import json
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_a_choice_is_asked_for_and_given_by_keyboard(plain_reader: Reader, book: Any) -> None:
    form = open_question(plain_reader, book, questions(book, "single")[0])
    form.locator("button[type=submit]").press("Enter")
    assert "Choose" in form.locator(".feedback").inner_text()
    assert form.get_attribute("data-answered") is None
    form.locator("input").first.focus()
    plain_reader.page.keyboard.press("Space")
    plain_reader.page.keyboard.press("Enter")
    assert form.get_attribute("data-answered") in ("correct", "wrong")


def test_a_number_is_asked_for_and_given_by_keyboard(plain_reader: Reader, book: Any) -> None:
    quiz = questions(book, "number")[0]
    form = open_question(plain_reader, book, quiz)
    form.locator("input[name=answer]").focus()
    plain_reader.page.keyboard.press("Enter")
    assert "Type a number" in form.locator(".feedback").inner_text()
    value = right_value(quiz) + 0.9 * quiz["tolerance"]
    plain_reader.page.keyboard.type(f"{value} {quiz['unit']}")
    plain_reader.page.keyboard.press("Enter")
    assert form.get_attribute("data-answered") == "correct"


def test_an_order_is_made_by_keyboard_and_by_dragging(plain_reader: Reader, book: Any) -> None:
    for quiz in questions(book, "order"):
        form = open_question(plain_reader, book, quiz)
        form.locator("button[type=submit]").press("Enter")
        assert form.get_attribute("data-answered") == "wrong", "no reader begins with the answer"
        for place in range(len(quiz["options"])):
            move_up(plain_reader, form, place, order_of(form).index(place) - place)
        assert order_of(form) == sorted(order_of(form))
        assert form.locator(".order-place").inner_text()
        form.locator("button[type=submit]").press("Enter")
        assert form.get_attribute("data-answered") == "correct"
    before = order_of(form)
    last, first = form.locator(".grip").last, form.locator(".grip").first
    start, end = plain_reader.bring(last), first.bounding_box()
    assert end is not None
    mouse = plain_reader.page.mouse
    mouse.move(start["x"] + start["width"] / 2, start["y"] + start["height"] / 2)
    mouse.down()
    mouse.move(end["x"] + end["width"] / 2, end["y"] + 2, steps=12)
    mouse.up()
    assert order_of(form) == [before[-1], *before[:-1]]


@pytest.mark.deep
def test_every_figure_question_is_solved_by_its_solution(visitor: Reader, book: Any) -> None:
    for place in book["chapters"]:
        asked = questions(book, "figure", place["id"])
        if asked:
            visitor.turn_to(place["url"])
        for quiz in asked:
            form = form_of(visitor, quiz)
            assert form.get_attribute("data-figure") == quiz["figure"]
            check(visitor, form, "wrong")
            assert form.locator(".explanation").inner_text()
            visitor.page.evaluate(SET, [quiz["figure"], quiz["solution"]])
            check(visitor, form, "correct")


def test_a_figure_is_set_and_checked_by_keyboard_alone(visitor: Reader, book: Any) -> None:
    quiz = next(q for q in questions(book, "figure") if q["id"] == "corner-twenty-inwards")
    visitor.turn_to(next(c["url"] for c in book["chapters"] if c["id"] == quiz["chapter"]))
    form = form_of(visitor, quiz)
    assert form.get_attribute("data-figure") == quiz["figure"]
    check(visitor, form, "wrong")
    slider = visitor.page.locator(f"#{quiz['figure']} input[name=k1]")
    slider.focus()
    while float(slider.input_value()) > -0.1:
        visitor.page.keyboard.press("ArrowLeft")
    check(visitor, form, "correct")


def test_without_python_a_figure_s_question_says_that_it_cannot_be_judged(
    plain_reader: Reader, book: Any
) -> None:
    form = open_question(plain_reader, book, questions(book, "figure")[0])
    form.locator("button[type=submit]").click()
    plain_reader.page.wait_for_function(
        "form => form.querySelector('.feedback').textContent", arg=form.element_handle()
    )
    assert "cannot be checked" in form.locator(".feedback").inner_text()
    assert form.get_attribute("data-answered") is None


def test_options_stand_in_an_order_of_the_reader_s_own_that_lasts(
    plain_reader: Reader, book: Any
) -> None:
    url = book["chapters"][3]["url"]
    plain_reader.open(url, live=False)
    orders = plain_reader.page.evaluate(ORDERS)
    assert all(sorted(order) == list(range(len(order))) for order in orders)
    assert any(order != sorted(order) for order in orders)
    plain_reader.open(url, live=False)
    assert plain_reader.page.evaluate(ORDERS) == orders
    plain_reader.page.evaluate("localStorage.clear()")
    others = [orders]
    for _ in range(3):
        plain_reader.open(url, live=False)
        others.append(plain_reader.page.evaluate(ORDERS))
        plain_reader.page.evaluate("localStorage.clear()")
    assert any(other != orders for other in others)


def test_progress_counts_lists_what_was_missed_and_is_reset(
    plain_reader: Reader, book: Any
) -> None:
    place = book["chapters"][9]
    plain_reader.open(live=False)
    assert plain_reader.page.locator(".progress").is_hidden(), "before the first answer"
    plain_reader.open(place["url"], live=False)
    section = plain_reader.page.locator("section.progress")
    total = len([quiz for quiz in book["quizzes"] if quiz["chapter"] == place["id"]])
    assert f"0 of {total} " in section.inner_text()
    right, wrong = questions(book, "number", place["id"])[:2]
    for quiz, value in ((right, right_value(right)), (wrong, right_value(wrong) + 77)):
        form_of(plain_reader, quiz).locator("input[name=answer]").fill(str(value))
        form_of(plain_reader, quiz).locator("button[type=submit]").click()
    assert f"1 of {total} " in section.inner_text()
    assert [a.get_attribute("href") for a in section.locator(".missed a").all()] == [
        f"#quiz-{wrong['id']}"
    ]
    plain_reader.open(live=False)
    assert f"1 of {len(book['quizzes'])} " in plain_reader.page.locator(".progress").inner_text()
    plain_reader.open(place["url"], live=False)
    section.locator("[data-progress-reset]").click()
    assert f"0 of {total} " in section.inner_text()
    plain_reader.page.reload()
    assert form_of(plain_reader, right).get_attribute("data-answered") is None


def test_progress_is_carried_over_as_a_file(
    plain_reader: Reader, book: Any, tmp_path: Path
) -> None:
    quiz = questions(book, "number")[0]
    form = open_question(plain_reader, book, quiz)
    form.locator("input[name=answer]").fill(str(right_value(quiz)))
    form.locator("button[type=submit]").click()
    page, section = plain_reader.page, plain_reader.page.locator("section.progress")
    with page.expect_download() as download:
        section.locator("[data-progress-export]").click()
    file = tmp_path / "progress.json"
    download.value.save_as(file)
    assert list(json.loads(file.read_text())["answers"]) == [f"quiz:{quiz['id']}"]
    page.evaluate("localStorage.clear()")
    page.reload()
    assert form.get_attribute("data-answered") is None
    give(plain_reader, file)
    expect(section.locator(".progress-said")).to_contain_text("1 answer")
    assert form.get_attribute("data-answered") == "correct"
    page.evaluate(EDIT, quiz["id"])
    page.reload()
    assert form.get_attribute("data-answered") is None, "to another edition it is asked again"


BROKEN = (
    ("{", "not JSON"),
    ("[]", "does not contain answers"),
    ('{"format": "image-formation-progress", "version": 9, "answers": {}}', "version"),
    ('{"format": "image-formation-progress", "version": 1, "answers": []}', "no answers"),
    (
        '{"format": "image-formation-progress", "version": 1, "answers":'
        '{"quiz:affine-dof": {"edition": "0", "answer": 6, "right": true}, "theme": "dark"}}',
        '"theme" is broken',
    ),
    (
        '{"format": "image-formation-progress", "version": 1, "answers":'
        '{"quiz:affine-dof": {"edition": "0", "answer": "six", "right": true}}}',
        '"quiz:affine-dof" is broken',
    ),
)


def test_a_broken_file_is_named_and_nothing_of_it_kept(
    plain_reader: Reader, tmp_path: Path
) -> None:
    plain_reader.open(live=False)
    said = plain_reader.page.locator(".progress-said")
    for number, (content, words) in enumerate(BROKEN):
        file = tmp_path / f"broken-{number}.json"
        file.write_text(content)
        plain_reader.page.locator(".progress-file").set_input_files(file)
        expect(said).to_contain_text(words)
    kept = plain_reader.page.evaluate("Object.keys(localStorage).filter(k => k.includes(':quiz'))")
    assert kept == []


ORDERS = """[...document.querySelectorAll('form.quiz fieldset')]
  .map((set) => [...set.querySelectorAll('input[type=radio], input[type=checkbox]')]
    .map((input) => Number(input.value)))
  .filter((order) => order.length)"""
EDIT = """id => {
  const key = `image-formation:quiz:${id}`;
  const kept = {...JSON.parse(localStorage[key]), edition: 'another'};
  localStorage[key] = JSON.stringify(kept);
}"""
SET = """([id, values]) => {
  const form = document.getElementById(id).querySelector('form.controls');
  for (const [name, value] of Object.entries(values)) {
    const control = form.elements[name];
    if (control.type === 'checkbox') control.checked = value === 'true';
    else control.value = value;
    control.dispatchEvent(new Event('input', {bubbles: true}));
    control.dispatchEvent(new Event('change', {bubbles: true}));
  }
}"""


def questions(book: Any, kind: str, chapter: str = "") -> list[Any]:
    return [
        quiz
        for quiz in book["quizzes"]
        if quiz["kind"] == kind and chapter in ("", quiz["chapter"])
    ]


def right_value(quiz: Any) -> float:
    return next(float(option["value"]) for option in quiz["options"] if option["correct"])


def open_question(reader: Reader, book: Any, quiz: Any) -> Locator:
    url = next(c["url"] for c in book["chapters"] if c["id"] == quiz["chapter"])
    reader.open(url, live=False)
    return form_of(reader, quiz)


def form_of(reader: Reader, quiz: Any) -> Locator:
    return reader.page.locator(f'form[data-quiz="{quiz["id"]}"]')


def check(reader: Reader, form: Locator, verdict: str) -> None:
    """Press the form's button by keyboard, and wait for that verdict."""
    form.locator("button[type=submit]").press("Enter")
    reader.page.wait_for_function(
        "([form, verdict]) => form.dataset.answered === verdict",
        arg=[form.element_handle(), verdict],
    )


def order_of(form: Locator) -> list[int]:
    return [int(i.get_attribute("value") or -1) for i in form.locator("input[name=answer]").all()]


def move_up(reader: Reader, form: Locator, place: int, times: int) -> None:
    item = form.locator(f'.order-item:has(input[value="{place}"])')
    item.locator("[data-move=up]").focus()
    for _ in range(times):
        reader.page.keyboard.press("Enter")


def give(reader: Reader, file: Path) -> None:
    reader.page.locator(".progress-file").set_input_files(file)
    reader.page.wait_for_function("document.querySelector('.progress-said').textContent")
