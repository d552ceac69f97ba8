"""Illustrations in a page: drawn, told in words, captioned; every mistake has its place."""

import sys
from collections.abc import Callable
from dataclasses import replace

import pytest
from support.little_book import diagnostics, rendered

from simulations.engine.drawing import polygon
from simulations.engine.frame import Panel
from simulations.engine.illustration import Illustration
from site_builder.build import Options
from site_builder.markdown.directives import illustration

NAME = "similar-triangles"
CAPTION = "Two *triangles*.\n:::\n"


def draw() -> Illustration:
    triangles = "".join(polygon([(0, 0), (size, 0), (0, size)]) for size in (30, 60))
    panel = Panel("plan", "Plan", 400, 300, overlay=triangles)
    return Illustration((panel,), "One triangle has twice the sides of the other.")


@pytest.fixture(autouse=True)
def _of_the_book(monkeypatch: pytest.MonkeyPatch) -> None:
    """This file's ``draw``, as if it lay where a book has its illustrations."""
    monkeypatch.setitem(illustration.MODULES, NAME, __name__)


def test_a_page_shows_the_drawing_its_words_and_its_caption(
    make_book: Callable[..., Options],
) -> None:
    body = f":::{{illustration}} {NAME}\n{CAPTION}"
    html = rendered(make_book(body))["first/index.html"].decode()
    drawn = draw()
    assert f'id="figure-{NAME}"' in html
    assert drawn.panels[0].overlay in html
    assert f'aria-label="{drawn.description}"' in html
    assert "Two <em>triangles</em>." in html


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (
            f":::{{illustration}} similar-triangle\n{CAPTION}",
            ":5: unknown illustration 'similar-triangle'; did you mean 'similar-triangles'?",
        ),
        (
            f":::{{illustration}} {NAME}\n:::\n",
            f":5: illustration '{NAME}' has no caption; legal: one to three sentences",
        ),
        (
            f"# Top {{#top}}\n\n:::{{illustration}} {NAME}\n:label: main\n{CAPTION}",
            ":8: duplicate illustration id 'main'; the page itself uses it",
        ),
    ],
    ids=["unknown", "no caption", "duplicate id"],
)
def test_a_mistake_is_told_with_its_line(
    make_book: Callable[..., Options], body: str, message: str
) -> None:
    found = [str(one) for one in diagnostics(make_book(body))]
    assert any(message in line for line in found), found


def test_a_drawing_that_fails_is_the_author_s_to_see(
    make_book: Callable[..., Options], monkeypatch: pytest.MonkeyPatch
) -> None:
    def tell_nothing() -> Illustration:
        return replace(Illustration((Panel("a", "", 1, 1),), "Shows."), description="")

    monkeypatch.setattr(sys.modules[__name__], "draw", tell_nothing)
    found = diagnostics(make_book(f":::{{illustration}} {NAME}\n{CAPTION}"))
    assert len(found) == 1
    assert found[0].message.startswith(f"illustration '{NAME}' cannot be drawn: ")
