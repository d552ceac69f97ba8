"""Symbols: what a formula's are, that each is declared for its chapter, and the page of them."""

from collections.abc import Callable

import pytest
from support.html_outline import read_html
from support.little_book import rendered

from site_builder.build import Options
from site_builder.markdown.text.symbols import covers, spelt, symbols_of

type MakeBook = Callable[..., Options]

FILE = "content/symbols.toml"
SYMBOLS = """\
[book]
'f' = ["focal length", "px"]

[first]
't_x' = ["the *shift*", "m"]
'f' = ["frequency", "1/m"]
"""
BODY = "\nA shift $t_x$, $t_y$.\n\n## More\n\n$$f = 1$$\n"


@pytest.mark.parametrize(
    ("tex", "symbols"),
    [
        (r"r_d = r\,(1 + k_1 r^2)", ["r_{d}", "r", "k_{1}", "r"]),
        (r"\mathbf{x}' \sim \hat{\mathbf n}_0 + \bar x", [r"\mathbf{x}", None, r"\bar{x}"]),
        (r"r_{\text{fold}} \cos\theta \text{ or } r_{n+1}", ["r_{«fold»}", r"\theta", "r_{n+1}"]),
        (r"\mathrm{SNR}_w + \role{image}{x} + \max y", ["x", "y"]),
        (r"\int E\,\mathrm{d}\lambda + \int L\,d\omega", ["E", r"\lambda", "L", r"\omega"]),
        (r"\begin{bmatrix} f_x & 0 \end{bmatrix} \dots", ["f_{x}"]),
        (r"\Delta E \ell", [r"\DeltaE", r"\ell"]),
    ],
)
def test_the_symbols_of_a_formula(tex: str, symbols: list[str | None]) -> None:
    found = list(symbols_of(tex))
    assert len(found) == len(symbols)
    for given, wanted in zip(found, symbols, strict=True):
        assert wanted is None or given.replace(" ", "") == wanted


@pytest.mark.parametrize(
    ("declared", "symbol", "covered"),
    [
        ("h_{11}", "h_{32}", True),
        ("t_x", "t_y", True),
        ("x", "x_0", True),
        (r"\mathbf{n}", "n_x", True),
        ("f_x", "f", False),
        ("z_s", "z_t", False),
        ("x", "y", False),
    ],
)
def test_a_meaning_covers_what_only_counts_differently(
    declared: str, symbol: str, covered: bool
) -> None:
    assert covers(spelt(declared), spelt(symbol)) is covered


def test_a_chapter_s_own_meaning_stands_before_the_book_s(make_book: MakeBook) -> None:
    page = read_html(rendered(make_book(BODY, {FILE: SYMBOLS}))["symbols/index.html"])
    cells = [cell.text for cell in page.all("td")]
    assert "frequency" in cells
    assert "focal length" not in cells
    places = [link.attributes["href"] for link in page.all("a") if "td" in link.inside]
    assert places == ["../first/", "../first/#more"]
