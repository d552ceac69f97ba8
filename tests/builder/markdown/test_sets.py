"""``{set}``: words of the text that are links to a setting of a figure of the page."""

import json
from collections.abc import Callable
from dataclasses import replace

import pytest
from support.html_outline import Element, read_html
from support.little_book import rendered

from site_builder.build import Options
from site_builder.diagnostics import Diagnostic

type Links = Callable[[str], list[Element]]
FIGURE = ":::{simulation} demo\n:::\n"


@pytest.fixture
def links(make_book: Callable[..., Options]) -> Links:
    """The links that the words of a chapter become."""

    def read(body: str) -> list[Element]:
        page = read_html(rendered(make_book(body))["first/index.html"])
        return page.all("a", "set")

    return read


def figures(links: list[Element]) -> list[str | None]:
    return [link.attributes["data-figure"] for link in links]


def test_a_link_holds_what_it_sets_and_leads_there_without_a_script(links: Links) -> None:
    [link] = links("Set {set}`it so <k1=-0.2 kind=b on=true tier=fast>`.\n\n" + FIGURE)
    assert json.loads(link.attributes["data-values"] or "") == {
        "k1": -0.2,
        "kind": "b",
        "on": True,
        "tier": "fast",
    }
    state = "figure-demo.k1=-0.2&figure-demo.kind=b&figure-demo.on=true&figure-demo.tier=fast"
    assert link.attributes["href"] == f"?{state}#figure-demo"


def test_words_set_the_figure_nearest_to_them_and_between_two_the_one_before(
    links: Links,
) -> None:
    set_it = "{set}`x <k1=0.1>`\n\n"
    body = f"{set_it}{FIGURE}\n{set_it}{FIGURE}\n\n\n{set_it}"
    assert figures(links(body)) == ["figure-demo", "figure-demo", "figure-demo-2"]


def test_words_in_a_caption_set_its_own_figure(links: Links) -> None:
    caption = ":::{simulation} demo\nOne.\n{set}`x <k1=0.1>`\n:::\n"
    assert figures(links(f"{FIGURE}{caption}{FIGURE}")) == ["figure-demo-2"]


def test_a_figure_that_is_named_is_set_wherever_it_stands(links: Links) -> None:
    assert figures(links(f"{{set}}`x <demo-2 k1=0.1>`\n\n{FIGURE}\n{FIGURE}")) == ["figure-demo-2"]


def test_words_that_set_may_hold_emphasis_and_formulae(
    make_book: Callable[..., Options],
) -> None:
    body = f"Set *now {{set}}`**the** $k_1$ so <k1=0>` at* once.\n\n{FIGURE}"
    page = rendered(make_book(body))["first/index.html"].decode()
    assert "<p>Set <em>now <a " in page
    assert '<strong>the</strong> <math aria-label="k sub 1" alttext="k sub 1">' in page
    assert "</math> so</a> at</em> once.</p>" in page


LABELLED = ":::{simulation} demo\n:label: strong-lens\n:::\n"


def test_a_labelled_figure_is_found_by_its_label_whatever_stands_before_it(links: Links) -> None:
    cited = "{set}`x <strong-lens k1=0.1>`\n\n"
    assert figures(links(f"{cited}{FIGURE}{LABELLED}")) == ["strong-lens"]
    assert figures(links(f"{cited}{LABELLED}{FIGURE}")) == ["strong-lens"]


@pytest.mark.parametrize("words", ["{set}`x <demo-2 k1=0.1>`", "{ref}`figure-demo-2`"])
def test_a_figure_cited_by_its_count_is_a_warning(
    make_book: Callable[..., Options], words: str
) -> None:
    warnings: list[Diagnostic] = []
    body = f"{words}\n\n{FIGURE}\n{FIGURE}"
    rendered(replace(make_book(body), warn=warnings.append))
    assert [str(one).split(";")[0] for one in warnings] == [
        "content/00-first.md:5: warning: 'figure-demo-2' depends on the order of the page"
    ]
