"""Questions: answers by mouse and keyboard, their grading, and progress files of readers and
classes."""

import json
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader, step

pytestmark = pytest.mark.browser


def questions(book: Any, kind: str, chapter: str = "") -> list[Any]:
    return [
        quiz
        for quiz in book["quizzes"]
        if quiz["kind"] == kind and chapter in ("", quiz["chapter"])
    ]


def right_value(quiz: Any) -> float:
    return next(float(option["value"]) for option in quiz["options"] if option["correct"])


def url_of(book: Any, item: Any) -> str:
    """Address of the chapter of a question."""
    return str(next(c["url"] for c in book["chapters"] if c["id"] == item["chapter"]))


def open_question(reader: Reader, book: Any, quiz: Any) -> Locator:
    reader.open(url_of(book, quiz), live=False)
    return form_of(reader, quiz)


def form_of(reader: Reader, quiz: Any) -> Locator:
    return reader.page.locator(f'form.quiz[data-quiz="{quiz["id"]}"]')


def verdict(form: Locator) -> str | None:
    return form.get_attribute("data-answered")


def give(form: Locator, value: object) -> None:
    form.locator("input[name=answer]").fill(str(value))
    form.locator("button[type=submit]").click()


def test_choices_and_numbers_are_answered_by_keyboard(plain_reader: Reader, book: Any) -> None:
    keyboard = plain_reader.page.keyboard
    form = open_question(plain_reader, book, questions(book, "single")[0])
    form.locator("button[type=submit]").press("Enter")
    assert "Choose" in form.locator(".feedback").inner_text()
    assert verdict(form) is None
    form.locator("input").first.focus()
    keyboard.press("Space")
    keyboard.press("Enter")
    assert verdict(form) in ("correct", "wrong")
    quiz = questions(book, "number")[0]
    plain_reader.turn_to(url_of(book, quiz), live=False)
    form = form_of(plain_reader, quiz)
    form.locator("input[name=answer]").focus()
    keyboard.press("Enter")
    assert "Type a number" in form.locator(".feedback").inner_text()
    value = right_value(quiz) + 0.9 * quiz["tolerance"]
    keyboard.type(f"{value} {quiz['unit']}")
    keyboard.press("Enter")
    assert verdict(form) == "correct"


def test_order_is_changed_by_keyboard_and_by_dragging(plain_reader: Reader, book: Any) -> None:
    page = plain_reader.page
    for quiz in questions(book, "order"):
        form = open_question(plain_reader, book, quiz)
        form.locator("button[type=submit]").press("Enter")
        assert verdict(form) == "wrong", "no reader begins with the answer"
        for place in range(len(quiz["options"])):
            item = form.locator(f'.order-item:has(input[value="{place}"])')
            item.locator("[data-move=up]").focus()
            for _ in range(order_of(form).index(place) - place):
                page.keyboard.press("Enter")
        assert order_of(form) == sorted(order_of(form))
        assert form.locator(".order-place").inner_text()
        form.locator("button[type=submit]").press("Enter")
        assert verdict(form) == "correct"
    before = order_of(form)
    plain_reader.scroll_to(form.locator(".order"))
    start = plain_reader.middle(form.locator(".grip").last)
    x, y = plain_reader.middle(form.locator(".grip").first)
    plain_reader.drag(start, (x, y - 15), steps=12)
    assert order_of(form) == [before[-1], *before[:-1]]


def order_of(form: Locator) -> list[int]:
    return [int(i.get_attribute("value") or -1) for i in form.locator("input[name=answer]").all()]


@pytest.mark.deep
def test_every_figure_question_is_solved_by_its_solution(visitor: Reader, book: Any) -> None:
    for place in book["chapters"]:
        quizzes = questions(book, "figure", place["id"])
        if quizzes:
            visitor.turn_to(place["url"])
        for quiz in quizzes:
            form = form_of(visitor, quiz)
            check(form, "wrong")
            assert form.locator(".explanation").inner_text()
            visitor.page.evaluate(SET, [quiz["figure"], quiz["solution"]])
            check(form, "correct")


SET = """([id, values]) => {
  const form = document.getElementById(id).querySelector('form.controls');
  for (const [name, value] of Object.entries(values)) {
    const control = form.querySelector(`:is(input, select)[name="${name}"]`);
    if (control.type === 'checkbox') control.checked = value === 'true';
    else control.value = value;
    control.dispatchEvent(new Event('input', {bubbles: true}));
    control.dispatchEvent(new Event('change', {bubbles: true}));
  }
}"""


def check(form: Locator, expected_verdict: str) -> None:
    """Press the form's button by keyboard, and wait for this verdict."""
    form.locator("button[type=submit]").press("Enter")
    expect(form).to_have_attribute("data-answered", expected_verdict)


def test_figure_question_is_graded_at_its_settings_and_only_with_python(
    visitor: Reader, plain_reader: Reader, book: Any
) -> None:
    quiz = next(q for q in questions(book, "figure") if q["id"] == "fold-at-the-corner")
    visitor.turn_to(url_of(book, quiz))
    form = form_of(visitor, quiz)
    assert form.get_attribute("data-figure") == quiz["figure"]
    check(form, "wrong")
    slider = visitor.page.locator(f"#{quiz['figure']} input[name=k1]")
    slider.focus()
    while float(slider.input_value()) > -0.33:
        visitor.page.keyboard.press("ArrowLeft")
    check(form, "correct")
    form = open_question(plain_reader, book, quiz)
    form.locator("button[type=submit]").click()
    expect(form.locator(".feedback")).to_contain_text("cannot be checked")
    assert verdict(form) is None


def test_order_of_options_differs_between_readers_and_is_kept(
    plain_reader: Reader, book: Any
) -> None:
    def open_chapter() -> Any:
        plain_reader.open(book["chapters"][3]["url"], live=False)
        return plain_reader.page.evaluate(ORDERS)

    orders = open_chapter()
    assert all(sorted(order) == list(range(len(order))) for order in orders)
    assert any(order != sorted(order) for order in orders)
    assert open_chapter() == orders
    others = []
    for _ in range(3):
        plain_reader.clear_storage()
        others.append(open_chapter())
    assert any(other != orders for other in others)


ORDERS = """[...document.querySelectorAll('form.quiz fieldset')]
  .map((set) => [...set.querySelectorAll('input[type=radio], input[type=checkbox]')]
    .map((input) => Number(input.value)))
  .filter((order) => order.length)"""


def test_progress_lists_mistakes_is_reset_and_moves_as_a_file(
    plain_reader: Reader, book: Any, tmp_path: Path
) -> None:
    page = plain_reader.page
    chapters = (each for each in book["chapters"] if len(questions(book, "number", each["id"])) > 1)
    place = next(chapters)
    plain_reader.open(live=False)
    assert page.locator(".progress").is_hidden(), "before the first answer"
    plain_reader.open(place["url"], live=False)
    section = page.locator("section.progress")
    total = len([quiz for quiz in book["quizzes"] if quiz["chapter"] == place["id"]])
    assert f"0 of {total} " in section.inner_text()
    right, wrong = questions(book, "number", place["id"])[:2]
    give(form_of(plain_reader, right), right_value(right))
    give(form_of(plain_reader, wrong), right_value(wrong) + 77)
    assert f"1 of {total} " in section.inner_text()
    missed = [link.get_attribute("href") for link in section.locator(".missed a").all()]
    assert missed == [f"#quiz-{wrong['id']}"]
    plain_reader.open(live=False)
    assert f"1 of {len(book['quizzes'])} " in page.locator(".progress").inner_text()

    plain_reader.open(place["url"], live=False)
    section.locator(".progress-name").fill(" Zoë: N/A Ünal ")
    with page.expect_download() as download:
        section.locator("[data-progress-export]").click()
    assert download.value.suggested_filename == "image-formation-progress-Zoë-N-A-Ünal.json"
    file = tmp_path / "progress.json"
    download.value.save_as(file)
    assert json.loads(file.read_text())["who"] == "Zoë: N/A Ünal"
    assert {*json.loads(file.read_text())["answers"]} == {
        f"quiz:{right['id']}",
        f"quiz:{wrong['id']}",
    }
    section.locator("[data-progress-reset]").click()
    assert f"0 of {total} " in section.inner_text()
    page.reload()
    form = form_of(plain_reader, right)
    assert verdict(form) is None
    page.locator(".progress-file").set_input_files(file)
    expect(section.locator(".progress-status")).to_contain_text("2 answers")
    assert verdict(form) == "correct"
    page.evaluate(OTHER_EDITION, right["id"])
    page.reload()
    assert verdict(form) is None, "another edition is asked again"


OTHER_EDITION = """id => {
  const key = `image-formation:quiz:${id}`;
  localStorage[key] = JSON.stringify({...JSON.parse(localStorage[key]), edition: 'another'});
}"""
HEAD = '{"format": "image-formation-progress", "version": 1, "answers":'
BROKEN = (
    ("{", "not JSON"),
    ("[]", "does not contain answers"),
    ('{"format": "image-formation-progress", "version": 9, "answers": {}}', "version"),
    (f"{HEAD} []}}", "no answers"),
    (
        f'{HEAD} {{"quiz:affine-dof": {{"edition": "0", "answer": 6, "right": true}},'
        ' "theme": "dark"}}',
        '"theme" is broken',
    ),
    (
        f'{HEAD} {{"quiz:affine-dof": {{"edition": "0", "answer": "six", "right": true}}}}}}',
        '"quiz:affine-dof" is broken',
    ),
    (
        f'{HEAD} {{"quiz:affine-dof": {{"edition": "0", "answer": [{480_000 * "0,"}0], "right":'
        " true}}}",
        '"quiz:affine-dof" is broken',
    ),
    (
        HEAD
        + json.dumps(
            {f"quiz:{n}": {"edition": "", "answer": 0, "right": True} for n in range(15_000)}
        )
        + "}",
        "0 answers",
    ),
)


def test_progress_file_that_is_broken_or_of_another_book_changes_nothing(
    plain_reader: Reader, tmp_path: Path
) -> None:
    plain_reader.open(live=False)
    page, file = plain_reader.page, tmp_path / "broken.json"
    for content, words in BROKEN:
        file.write_text(content)
        page.locator(".progress-file").set_input_files(file)
        expect(page.locator(".progress-status")).to_contain_text(words)
    stored = page.evaluate("Object.keys(localStorage).filter(k => k.includes(':quiz'))")
    assert stored == []


def test_progress_files_of_a_class_become_a_table_without_uploads(
    plain_reader: Reader, tmp_path: Path
) -> None:
    """Answers to another edition of a question do not count."""
    page = plain_reader.page
    plain_reader.open("class/", live=False)
    quizzes = json.loads(page.locator(".class-data").text_content() or "")
    choice = next(each for each in quizzes if each["kind"] == "single")
    number = next(each for each in quizzes if each["kind"] == "number")
    options = [option["correct"] for option in choice["options"]]
    right, trap = options.index(True), options.index(False)
    files = [tmp_path / f"=Student {who}.json" for who in range(11)]
    files.append(tmp_path / "of the twelfth.json")
    for who, file in enumerate(files):
        first = right if who < 4 else trap
        edition = number["edition"] if who < 10 else "another"
        chosen = {"answer": [right], "right": True, "first": [first]}
        answers = {
            f"quiz:{choice['id']}": {"edition": choice["edition"], **chosen},
            f"quiz:{number['id']}": {"edition": edition, "answer": 0.125, "right": False},
        }
        named = ', "who": "=Student 0"' if who == 11 else ""
        file.write_text(f"{HEAD} {json.dumps(answers)}{named}}}")
    with step("twelve files are read, and the broken one is named"):
        methods: list[str] = []
        page.on("request", lambda request: methods.append(request.method))
        broken = tmp_path / "broken.json"
        broken.write_text("{")
        page.locator(".class-files").set_input_files([*files, broken])
        expect(page.locator(".class-tables details")).to_have_count(2)
        message = page.locator(".class-status").inner_text()
        assert "12 files, 2 questions" in message
        assert "broken.json" in message

    with step("each question has its answers"):

        def summary(question: Any) -> str:
            return page.locator("summary", has_text=question["name"]).inner_text()

        assert "12 answered, 4 right at first, 12 right at last" in summary(choice)
        assert summary(choice).endswith(f"(8): {choice['options'][trap]['text']}")
        assert "10 answered, 0 right" in summary(number)
    with step("the table is saved as CSV"):
        with page.expect_download() as download:
            page.locator(".class-csv").click()
        rows = Path(download.value.path()).read_text("utf-8").splitlines()
        assert rows[0].startswith("\ufeffquestion,who,"), "known to be UTF-8"
        assert len(rows) == 1 + 12 + 10
        assert sum(row.startswith(f"{number['id']},'=Student ") for row in rows) == 10
        assert sum(row.startswith(f"{choice['id']},'=Student 0 (2),") for row in rows) == 1
        assert {*methods} <= {"GET"}
