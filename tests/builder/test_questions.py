"""Questions exported to Moodle XML and QTI: their content, and grading as in the book."""

import io
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import moodle_xml_parser.parser as moodle_reader
import onyx2moodle.parser as qti_reader
import pytest
from onyx2moodle.classifier import classify
from support.little_book import FIXTURES, OUTLINE, write_book
from support.qti import QTI, illegal_parts, session_after

from site_builder.build import Options, load
from site_builder.document.book import Book
from site_builder.editions.questions import (
    ExportedQuestion,
    count_not_exported,
    exported_questions,
    make_moodle,
    make_qti,
)

SITE = "https://host/book/"
MACROS = '[macros]\nhalf = "\\\\frac{1}{2}"\nthird = "\\\\frac{1}{3}"\n'
MATHML = "{http://www.w3.org/1998/Math/MathML}"
CP = "{http://www.imsglobal.org/xsd/imscp_v1p1}"


@pytest.fixture(scope="module")
def options(tmp_path_factory: pytest.TempPathFactory) -> Options:
    body = (FIXTURES / "questions.md").read_text(encoding="utf-8")
    folder = tmp_path_factory.mktemp("questions")
    return write_book(folder, body, {"content/book.toml": OUTLINE + MACROS})


@pytest.fixture(scope="module")
def book(options: Options) -> Book:
    loaded = load(options)
    assert not loaded.sources.problems.found
    return replace(loaded.book, address=SITE)


@pytest.fixture(scope="module")
def moodle(book: Book) -> dict[str, Element]:
    """Questions by their ids."""
    root = ElementTree.fromstring(make_moodle(book))
    return {
        question.findtext("idnumber", ""): question
        for question in root.iter("question")
        if question.get("type") != "category"
    }


@pytest.fixture(scope="module")
def package(book: Book) -> dict[str, str]:
    archive = zipfile.ZipFile(io.BytesIO(make_qti(book)))
    return {name: archive.read(name).decode() for name in archive.namelist()}


IN_MOODLE: dict[str, tuple[str, list[tuple[str, float, str]]]] = {
    "one-of-two": (
        "multichoice",
        [
            (r"Here, at \(\def\half{\frac{1}{2}}\half\)", 0, "No &amp; never."),
            ("There", 100, r"Yes, as <em>always</em> for \(\mathrm{sinc}\)."),
        ],
    ),
    "two-of-three": (
        "multichoice",
        [
            ("First", 50, "The first is."),
            ("Second", -100, "The second is not."),
            ("Third", 50, "The third is."),
        ],
    ),
    "a-length": (
        "numerical",
        [
            ("50", 100, "That is it."),
            ("0.3", 0, "That is the sum."),
            ("*", 0, "That is something else."),
        ],
    ),
    "in-a-row": ("ordering", [("One", 1, ""), ("Two", 2, ""), ("Three", 3, "")]),
    "set-it": ("essay", []),
    "write-it": ("essay", []),
}
"""The kind of each question, with the text, the share of the points in per cent and the reply of
each answer."""


@pytest.mark.parametrize("name", IN_MOODLE)
def test_moodle_question_has_its_kind_answers_and_replies(
    moodle: dict[str, Element], name: str
) -> None:
    found = [
        (
            answer.findtext("text", ""),
            float(answer.get("fraction", "")),
            answer.findtext("feedback/text", ""),
        )
        for answer in moodle[name].iter("answer")
    ]
    assert (moodle[name].get("type"), found) == IN_MOODLE[name]


def test_moodle_questions_have_tex_site_links_tolerances_and_units(
    moodle: dict[str, Element],
) -> None:
    assert moodle["one-of-two"].findtext("questiontext/text") == (
        r"Where is \(x &lt; \boldsymbol{y}\), "
        f'as <a href="{SITE}second/#a-section">the second chapter</a> says?'
    )
    length = moodle["a-length"]
    assert [each.text for each in length.iter("tolerance")] == ["1", "0.15", "0"], "0.3 is not 0"
    assert [each.text for each in length.iter("unit_name")] == ["mm"]
    assert "_____ mm" in length.findtext("questiontext/text", "")


def test_shares_of_right_answers_are_grades_of_moodle(book: Book) -> None:
    quiz = next(each.quiz for each in exported_questions(book) if each.quiz.id == "two-of-three")
    right = next(option for option in quiz.options if option.correct)
    for count, share in (
        (1, 100),
        (3, 33.33333),
        (7, 14.28571),
        (10, 10),
        (11, 10),
        (20, 5),
        (30, 5),
    ):
        many = replace(quiz, options=(right,) * count)
        exported = ExportedQuestion(many, "", book.chapters[0], "")
        assert exported.share == share


def test_question_about_a_figure_has_its_link_and_a_solution(moodle: dict[str, Element]) -> None:
    question = moodle["set-it"]
    assert f'href="{SITE}embed/first/figure-demo/"' in question.findtext("questiontext/text", "")
    solved = f"{SITE}embed/first/figure-demo/?k1=0.25&amp;kind=b"
    assert f'href="{solved}"' in question.findtext("graderinfo/text", "")


def test_export_without_an_address_has_no_links_or_figure_questions(book: Book) -> None:
    assert count_not_exported(book) == 0
    book = replace(book, address="")
    assert {"set-it", "write-it"}.isdisjoint(item.quiz.id for item in exported_questions(book))
    assert count_not_exported(book) == 2
    assert b"href" not in make_moodle(book)


def test_qti_package_lists_each_of_its_files_once(package: dict[str, str]) -> None:
    manifest = ElementTree.fromstring(package["imsmanifest.xml"])
    listed = [file.get("href", "") for file in manifest.iter(f"{CP}file")]
    assert sorted([*listed, "imsmanifest.xml"]) == sorted(package)
    items = ElementTree.fromstring(package["test.xml"]).iter(f"{QTI}assessmentItemRef")
    assert [each.get("href") for each in items] == listed[1:]


@pytest.mark.parametrize(
    ("question", "answer", "score", "replies"),
    [
        ("one-of-two", "answer-2", 1, ["Yes, as always for sinc."]),
        ("one-of-two", "answer-1", 0, ["No & never."]),
        ("two-of-three", ["answer-3", "answer-1"], 1, ["The first is.", "The third is."]),
        ("two-of-three", ["answer-1"], 0.5, ["The first is."]),
        ("two-of-three", ["answer-1", "answer-2"], 0, ["The first is.", "The second is not."]),
        ("a-length", 51.0, 1, ["That is it."]),
        ("a-length", 51.1, 0, ["That is something else."]),
        ("a-length", 0.3, 0, ["That is the sum."]),
        ("a-length", None, 0, []),
        ("in-a-row", ["answer-1", "answer-3", "answer-2"], 0, ["It is the third."]),
        (
            "in-a-row",
            ["answer-1", "answer-2", "answer-3"],
            1,
            ["One It is the first. Two It is the second. Three It is the third."],
        ),
    ],
)
def test_qti_item_scores_and_replies_like_the_book(
    package: dict[str, str], question: str, answer: str, score: float, replies: list[str]
) -> None:
    session = session_after(package[f"items/quiz-{question}.xml"], answer)
    assert (session.score, session.replies) == (score, replies)


def test_qti_files_are_legal_by_the_schemas(package: dict[str, str]) -> None:
    assert not illegal_parts(package)


def test_lengths_in_formulae_of_qti_have_a_unit(package: dict[str, str]) -> None:
    item = ElementTree.fromstring(package["items/quiz-one-of-two.xml"])
    assert {part.get("lspace") for part in item.iter(f"{MATHML}mpadded")} == {"0em"}


def test_other_importers_read_both_formats(
    book: Book, package: dict[str, str], tmp_path: Path
) -> None:
    """Questions about an order are left out, which the QTI schema does not have."""
    read = moodle_reader.parse_bytes(make_moodle(book))["multichoice"]
    assert [(one.single, len(one.options)) for one in read] == [(True, 2), (False, 3)]
    found = []
    for name in ("one-of-two", "two-of-three", "a-length", "set-it"):
        file = tmp_path / f"{name}.xml"
        file.write_text(package[f"items/quiz-{name}.xml"], encoding="utf-8")
        found.append(classify(qti_reader.parse_item(file)).target)
    assert found == ["multichoice", "multichoice", "shortanswer", "essay"]
