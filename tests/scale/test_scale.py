"""The books that `make bench-scale` builds, and what it says of their costs."""

import math
import re
from pathlib import Path

import pytest
from scale.cost import Cost, growth
from scale.report import Run, report
from scale.text import BOOKS, MKDOCS, MYST, OURS, chapter, plain_chapter
from scale.trees import BUILDERS, edit_line, write_book

from site_builder.build import Options, check_site
from site_builder.markdown.text.math import to_mathml


@pytest.mark.parametrize("power", [0.5, 1.0, 2.0])
def test_growth_is_the_power_of_the_size(power: float) -> None:
    sizes = [10, 100, 1000]
    assert growth(sizes, [3 * size**power for size in sizes]) == pytest.approx(power)


def test_of_one_size_no_growth_is_known() -> None:
    assert math.isnan(growth([10], [1.0]))


@pytest.mark.parametrize(("kind", "questions"), [("everything", 2), ("prose", 0)])
def test_our_long_books_have_no_mistakes(kind: str, questions: int, tmp_path: Path) -> None:
    write_book(BUILDERS[0], 2, tmp_path, kind)
    book, _, _ = check_site(Options(tmp_path, runtime=False))
    assert [len(chapter.quizzes) for chapter in book.chapters] == [questions, questions]


def test_builders_get_the_same_words() -> None:
    ours, mkdocs, myst = (chapter(3, 9, notation) for notation in (OURS, MKDOCS, MYST))
    sentences = re.compile(r"^(?:The|Then|So) .*$", re.MULTILINE)
    assert set(sentences.findall(mkdocs)) >= set(sentences.findall(ours)) - {"The curve 3."}
    assert sentences.findall(myst) == sentences.findall(ours)


def test_prose_is_the_same_for_all_builders() -> None:
    assert len({plain_chapter(3, 9, notation) for notation in (OURS, MKDOCS, MYST)}) == 1


def test_no_two_formulae_are_alike() -> None:
    texts = [chapter(number, 9, OURS) for number in (1, 2)]
    shown = [tex for text in texts for tex in re.findall(r"\$\$\n(.*)\n\$\$", text)]
    assert len({to_mathml(tex, display=True) for tex in shown}) == len(shown) == 10


@pytest.mark.parametrize("kind", BOOKS)
@pytest.mark.parametrize("builder", BUILDERS, ids=lambda builder: builder.title)
def test_an_edit_changes_one_line_of_one_file(builder: object, kind: str, tmp_path: Path) -> None:
    (chosen,) = (item for item in BUILDERS if item is builder)
    write_book(chosen, 3, tmp_path, kind)
    before = {file: file.read_text() for file in tmp_path.rglob("*") if file.is_file()}
    edit_line(chosen, 3, tmp_path, "then")
    changed = [file for file, text in before.items() if file.read_text() != text]
    assert [file.stem for file in changed] == ["chapter-0002"]
    old, new = before[changed[0]].splitlines(), changed[0].read_text().splitlines()
    assert sum(a != b for a, b in zip(old, new, strict=True)) == 1


def test_the_report_tells_costs_as_shares_of_mkdocs() -> None:
    runs = [
        Run("ours", 10, Cost(4, 5, 6), Cost(1, 2, 3)),
        Run("MkDocs", 10, Cost(2, 3, 4), Cost(4, 5, 6)),
    ]
    row = next(line for line in report(runs).splitlines() if "| ours |" in line)
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert (cells[5], cells[8]) == ("2.00", "0.25")
