"""Dropping a chapter into ``fixtures/pages`` makes a test: beside it lies the HTML of its text."""

from collections.abc import Callable
from pathlib import Path

import pytest
from support.html_outline import read_html
from support.little_book import rendered
from support.recorded import assert_recorded

from site_builder.build import Options

FIXTURES = Path(__file__).parents[2] / "fixtures" / "pages"


@pytest.mark.parametrize("file", sorted(FIXTURES.glob("*.md")), ids=lambda file: file.stem)
def test_a_chapter_becomes_the_recorded_html(file: Path, make_book: Callable[..., Options]) -> None:
    options = make_book(files={"content/00-first.md": file.read_text(encoding="utf-8")})
    page = rendered(options)["first/index.html"]
    read_html(page)
    text = page.decode().partition('<article class="chapter">')[2]
    text = text.partition("</header>")[2].partition("</article>")[0].strip() + "\n"
    assert_recorded(text, file.with_suffix(".html"))
