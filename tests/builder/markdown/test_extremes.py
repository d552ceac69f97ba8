"""A table of hard cases in a page: all of them, with answers computed while the page is made."""

from collections.abc import Callable

import pytest
from support.little_book import rendered

from simulations.engine.hard_cases import HardCase, HardCases, LibraryAnswer, near, refused
from site_builder.build import Options
from site_builder.markdown.directives import extremes


def half_of(length: float) -> float:
    if length < 0:
        raise ValueError(f"length={length:g}; legal: 0 or more")
    return length / 2


TABLE = HardCases(
    id="halves",
    title="Halving a length",
    names={"half_of": half_of},
    cases=(
        HardCase(
            id="odd",
            call="half_of(641)",
            why="no whole number",
            returns="the fraction",
            expected=near(320.5),
            naive="641 // 2",
            library=LibraryAnswer("numpy.divide(641, 2)", "[320, 240]"),
        ),
        HardCase(
            id="less-than-nothing",
            call="half_of(-1)",
            why="no length at all",
            returns="a refusal",
            expected=refused("length"),
        ),
    ),
)


def test_a_table_shows_every_case_what_the_model_answers_and_what_others_do(
    make_book: Callable[..., Options], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With this file's table, as if it lay where a book has its tables."""
    monkeypatch.setitem(extremes.MODULES, "halves", __name__)
    page = rendered(make_book(":::{extremes} halves\n:::\n"))["first/index.html"].decode()
    for case in TABLE.cases:
        assert f'id="extremes-halves-{case.id}"' in page
        assert case.call in page
    assert "320.5" in page
    assert "ValueError: length=-1; legal: 0 or more" in page
    assert ">320<" in page, "the textbook's formula"
    assert "[320, 240]" in page, "the library's answer"
