"""Questions that draw their numbers: every combination is computed, checked and exported."""

import io
import json
import re
import zipfile
from collections.abc import Callable
from xml.etree import ElementTree

import pytest
from support.little_book import OUTLINE, diagnostics, rendered

from site_builder.build import Options, load
from site_builder.document.book import Book
from site_builder.document.questions import Quiz
from site_builder.editions.questions.asked import asked_in, left_out
from site_builder.editions.questions.moodle import make_moodle
from site_builder.editions.questions.qti import make_qti
from site_builder.render.words import plain_words

QUIZ = r"""
```calc
twice = lambda number: 2 * number
```

:::{quiz} how-wide
:kind: number
:unit: mm
:within: 2%
:draw: f = 50, twice(50); N = 2, 2.5
How wide is the hole of {calc}`f` mm at $N = \calc{N}$?
- [x] `f / N`
  : $\calc{f} / \calc{N}$
- [ ] `f * N`
  : Not {calc}`f * N`.
- [ ] otherwise
  : Divide.
:::

:::{quiz} undrawn
Which?
- [x] This
  : Yes.
- [ ] That
  : No.
:::
"""
QTI = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"

type MakeBook = Callable[..., Options]


@pytest.fixture
def options(make_book: MakeBook) -> Options:
    return make_book(QUIZ, {"content/book.toml": OUTLINE})


@pytest.fixture
def book(options: Options) -> Book:
    loaded = load(options)
    assert not loaded.problems.found
    return loaded.book


@pytest.fixture
def quiz(book: Book) -> Quiz:
    return book.chapters[0].quizzes[0]


def test_prompt_answers_tolerance_and_replies_are_computed_for_each_combination(
    quiz: Quiz,
) -> None:
    assert [variant.drawn for variant in quiz.variants] == [
        "f = 50; N = 2", "f = 50; N = 2.5", "f = 100; N = 2", "f = 100; N = 2.5",
    ]  # fmt: skip
    last = quiz.variants[-1]
    assert last.prompt_text == "How wide is the hole of 100 mm at N = 2.5"
    assert [option.value for option in last.options] == [40, 250, None]
    assert last.details.tolerance == pytest.approx(0.8)
    assert plain_words(last.options[1].explanation) == "Not 250."
    assert len({variant.edition for variant in quiz.variants}) == 4


def test_a_chapter_collects_what_is_in_the_first_combination_alone(book: Book) -> None:
    formulae = [formula.tex for formula in book.chapters[0].formulae]
    assert formulae == ["N = 2", "50 / 2"]


def test_the_page_shows_the_first_and_carries_all(options: Options) -> None:
    page = rendered(options)["first/index.html"].decode()
    (asked,) = re.findall(r'<p class="asked"[^>]*>(How wide.*?)</p>', page, re.DOTALL)
    assert "50" in asked
    found = re.findall(r'class="quiz-data">(.*?)</script>', page, re.DOTALL)
    drawn, undrawn = map(json.loads, found)
    variants = [variant["fieldset_html"] for variant in drawn["variants"]]
    assert ["100" in text for text in variants] == [False, False, True, True]
    assert all('name="answer"' in text for text in variants)
    assert "variants" not in undrawn
    assert page.count("data-draw") == 1


@pytest.mark.parametrize(
    ("draw", "gist"),
    [
        ("f", "'f' draws no number; legal: each name once"),
        ("f = 1, 2; f = 3, 4", "'f = 3, 4' draws no number; legal: each name once"),
        ("lambda = 1, 2", "'lambda = 1, 2' draws no number"),
        ("f = 1, 2, N = 3", "'f = 1, 2, N = 3' draws no number"),
        (
            'f = readout("demo", "k1", k1=0.1), readout("demo", "k1", k1=0)',
            "with f = 0: '1 / f': ZeroDivision",
        ),
        ("f = 1, 1", "'f = 1, 1' draws a number twice"),
        ("f = 1,5", "'1,5'; legal: a decimal point, or a space behind each comma"),
        ("f = 1, ?", "'1, ?' is no expression"),
        ("f = 1", "quiz 'q' draws from 1 combinations; legal: 2 to 60"),
        ("f = 1, 2, 3, 4, 5, 6, 7, 8; N = 1, 2, 3, 4, 5, 6, 7, 8", "draws from 64 combinations"),
        ("f = 2, 3; N = 1, 2", "is the same with f = 2; N = 1 and with f = 2; N = 2"),
        ("f = 2, 0", "with f = 0: '1 / f': ZeroDivisionError"),
        ("f = 2, 1", "with f = 1: 'f' is 1 and '1 / f' is 1: within 0.01 they cannot be told"),
    ],
)
def test_mistakes_are_told_at_their_line_and_with_their_combination(
    make_book: MakeBook, draw: str, gist: str
) -> None:
    lines = [
        ":::{quiz} q", ":kind: number", ":within: 1%", f":draw: {draw}", "What is {calc}`f`?",
        "- [x] `1 / f`", "  : So.", "- [ ] `f`", "  : No.", "- [ ] otherwise", "  : No.", ":::",
    ]  # fmt: skip
    found = diagnostics(make_book("\n".join(lines), {"content/book.toml": OUTLINE}))
    mistake = next(each for each in found if gist in each.message)
    expected = 8 if "told" in gist else 6 if "Zero" in gist else 4
    assert mistake.line == 4 + expected


def test_what_needs_a_figure_or_is_guessed_draws_nothing(make_book: MakeBook) -> None:
    body = (
        ":::{simulation} demo\n:::\n\n:::{quiz} q\n:kind: figure\n:figure: figure-demo\n"
        ":solution: k1=0.1\n:draw: f = 1, 2\nDo {calc}`f`.\n- [x] `k1 > 0`\n  : b\n"
        "- [ ] otherwise\n  : d\n:::\n\n:::{predict} p\n:draw: f = 1, 2\nWhich?\n"
        "- [x] One\n- [ ] Two\n  : No.\n:::\n\n:::{answer} p\nOne.\n:::\n"
    )
    found = diagnostics(make_book(body, {"content/book.toml": OUTLINE}))
    gists = ["option 'draw' of a 'figure' quiz", "unknown option of {predict} 'draw'"]
    for gist in gists:
        assert any(gist in mistake.message for mistake in found), gist


def test_each_combination_is_a_question_of_moodle_in_a_category_of_its_own(book: Book) -> None:
    asked = list(asked_in(book))
    assert [each.key for each in asked] == [
        "how-wide_1", "how-wide_2", "how-wide_3", "how-wide_4", "undrawn",
    ]  # fmt: skip
    assert left_out(book) == 0
    root = ElementTree.fromstring(make_moodle(book))
    categories = [each.findtext("category/text", "") for each in root.iter("question")]
    drawn, other = filter(None, categories)
    assert drawn == f"{other}/Question 0.1"
    names = [each.findtext("name/text") for each in root.iter("question")]
    assert "Question 0.1 (f = 100; N = 2.5)" in names


def test_a_test_of_qti_selects_one_combination(book: Book) -> None:
    package = zipfile.ZipFile(io.BytesIO(make_qti(book)))
    test = ElementTree.fromstring(package.read("test.xml"))
    drawn = next(
        each
        for each in test.iter(f"{QTI}assessmentSection")
        if each.find(f"{QTI}selection") is not None
    )
    (selection,) = drawn.iter(f"{QTI}selection")
    assert selection.get("select") == "1"
    assert len(list(drawn.iter(f"{QTI}assessmentItemRef"))) == 4
    assert len(list(test.iter(f"{QTI}assessmentItemRef"))) == 5
