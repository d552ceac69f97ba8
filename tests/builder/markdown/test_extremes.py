"""A table of hard cases in a page: all of them, with answers computed while the page is made."""

from collections.abc import Callable

from simulations.engine.hard_cases import answer, show
from simulations.hard_cases import projection
from site_builder.build import Options, render_site


def test_a_table_shows_every_case_and_its_answer(make_book: Callable[..., Options]) -> None:
    options = make_book(":::{extremes} projection\n:::\n")
    page = render_site(options)["first/index.html"]
    assert isinstance(page, bytes)
    text = page.decode()
    for case in projection.TABLE.cases:
        assert f'id="extremes-projection-{case.id}"' in text
    first = projection.TABLE.cases[0]
    assert show(answer(projection.TABLE, first)) in text
    assert "[320, 240]" in text, "the library's answer"
