"""Symbols: what a formula's are, that each is declared for its chapter, and the page of them."""

from collections.abc import Callable

import pytest
from support.html_outline import read_html

from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics import Diagnostic
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.output.assets import content_bytes

type MakeBook = Callable[..., Options]
type Find = Callable[..., list[str]]

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


def test_a_symbol_that_is_not_declared_for_its_chapter_is_told(mistakes: Find) -> None:
    found = mistakes(f"{BODY}\n$$g = h_d$$\n", {FILE: SYMBOLS})
    assert [line.partition("; ")[0] for line in found] == [
        "content/00-first.md:12: unknown symbol in first 'g'",
        "content/00-first.md:12: unknown symbol in first 'h_{d}'",
    ]


@pytest.mark.parametrize(
    ("before", "after", "report"),
    [
        ("[first]", "[frist]", "4: unknown chapter 'frist'; did you mean 'first'?"),
        ("'t_x'", "'t_x u'", "5: 't_x u'; legal: one symbol"),
        ('["focal length", "px"]', '"focal length"', "2: 'f'; legal: "),
        ("[book]", "[book", "1: malformed TOML"),
        ("[book]", "", "2: 'f' outside a table"),
        ("*shift*", "{ref}`nowhere`", "5: unknown target 'nowhere'"),
    ],
)
def test_a_mistake_in_the_list_is_told_with_its_place(
    mistakes: Find, before: str, after: str, report: str
) -> None:
    found = mistakes(BODY, {FILE: SYMBOLS.replace(before, after, 1)})
    assert any(line.startswith(f"{FILE}:{report}") for line in found), found


def test_a_meaning_of_no_symbol_is_warned_of(make_book: MakeBook) -> None:
    warnings: list[Diagnostic] = []
    options = make_book("\nA shift $t_x$.\n", {FILE: SYMBOLS})
    check_site(Options(options.root, load_scene=options.load_scene, warn=warnings.append))
    assert [(item.line, "in no formula" in item.message) for item in warnings] == [
        (2, True),
        (6, True),
    ]


def test_a_chapter_s_own_meaning_stands_before_the_book_s(make_book: MakeBook) -> None:
    page = read_html(
        content_bytes(render_site(make_book(BODY, {FILE: SYMBOLS}))["symbols/index.html"])
    )
    cells = [cell.text for cell in page.all("td")]
    assert "frequency" in cells
    assert "focal length" not in cells
    places = [link.attributes["href"] for link in page.all("a") if "td" in link.inside]
    assert places == ["../first/", "../first/#more"]
