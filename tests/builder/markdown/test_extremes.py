"""A table of hard cases in a page: all of them, with answers computed while the page is made."""

from collections.abc import Callable
from pathlib import Path

import pytest
from support.little_book import rendered

from site_builder.build import Options
from site_builder.markdown.directives import extremes

TABLE = f"""
title = "Halving a length"
names = ["{__name__}:half_of"]

[cases.odd]
call = "half_of(641)"
why = "no whole number"
returns = "the fraction"
expected = "near(320.5)"
naive = "641 // 2"
library = "numpy.divide(641, 2)"
library_answer = "[320, 240]"

[cases.less-than-nothing]
call = "half_of(-1)"
why = "no length at all"
returns = "a refusal"
expected = "refused('length')"
"""


def half_of(length: float) -> float:
    if length < 0:
        raise ValueError(f"length={length:g}; legal: 0 or more")
    return length / 2


def test_a_table_shows_every_case_what_the_model_answers_and_what_others_do(
    make_book: Callable[..., Options], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    file = tmp_path / "halves.toml"
    file.write_text(TABLE, encoding="utf-8")
    monkeypatch.setitem(extremes.FILES, "halves", file)
    page = rendered(make_book(":::{extremes} halves\n:::\n"))["first/index.html"].decode()
    assert 'id="extremes-halves-odd"' in page
    assert 'id="extremes-halves-less-than-nothing"' in page
    assert "half_of(-1)" in page
    assert "320.5" in page
    assert "ValueError: length=-1; legal: 0 or more" in page
    assert ">320<" in page, "the textbook's formula"
    assert "[320, 240]" in page, "the library's answer"
