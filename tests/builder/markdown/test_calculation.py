"""Numbers that a page computes from expressions."""

from pathlib import Path

import pytest
from markdown_it.token import Token
from support.small_package import PACKAGE, small_package

from simulations.engine.scene import Scene
from site_builder.diagnostics.diagnostic import Diagnostic, Diagnostics
from site_builder.document.passage import passage
from site_builder.languages.words import ENGLISH
from site_builder.markdown.inline import annotate
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.parser import make_parser
from site_builder.render.screen import screen_renderer
from site_builder.sandbox.pool import Limits, limited


def load_scene(name: str) -> Scene[object]:
    raise LookupError(name)


def annotated(text: str) -> tuple[list[Token], list[Diagnostic]]:
    context = ParseContext("a.md", Shared(Path(), load_scene, make_parser()), Diagnostics())
    tokens = context.shared.parser.parse(text, context.env)
    annotate(tokens, context)
    return tokens, context.problems.found


def rendered(text: str) -> str:
    tokens, mistakes = annotated(text)
    assert not mistakes
    return screen_renderer(ENGLISH)(passage(tokens))


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        ("1 / 4", "0.25"),
        ("2 / 3:.2f", "0.67"),
        ("-2 / 3:.1f", "−0.7"),
        ("-0.001:.1f", "0.0"),
        ("0.00006211:.1e", "6.2\u202f×\u202f10⁻⁵"),
        ("12345:,.0f", "12\u00a0345"),
        ("(1, 2)[1]", "2"),
        ("(1 / 4, -2):.1f", "0.2, −2.0"),
    ],
)
def test_a_number_in_a_sentence(written: str, shown: str) -> None:
    assert rendered(f"It is {{calc}}`{written}`.") == f"<p>It is {shown}.</p>"


def test_a_block_names_functions_and_values_for_what_stands_below_it() -> None:
    lines = (
        "from numpy.linalg import inv",
        "half = lambda x: x / 2",
        "a, b = inv(((2, 0), (0, 4))) @ (1, 2)",
    )
    block = "\n".join(("```calc", *lines, "```"))
    shown = rendered(block + "\n\nIt is {calc}`half(3)`, {calc}`a` and {calc}`b`.")
    assert shown == "<p>It is 1.5, 0.5 and 0.5.</p>"


def test_functions_of_the_models_run_within_limits(tmp_path: Path) -> None:
    source = """
import os
def loop():
    while True: pass
def read(name):
    return len(open(name).read())
def leave():
    os._exit(3)
"""
    block = f"```calc\nfrom {PACKAGE}.odd import leave, loop, read\n```"
    calls = ("loop()", "read('/etc/hostname')", "leave()")
    with small_package(tmp_path, {"odd": source}), limited(Limits(seconds=0.3)):
        _, mistakes = annotated("\n\n".join((block, *(f"{{calc}}`{call}`" for call in calls))))
    expected = ("takes more than 0.3 s", "reads '/etc/hostname'", "ended by its own code, as 3")
    assert [found.line for found in mistakes] == [5, 7, 9]
    for found, words in zip(mistakes, expected, strict=True):
        assert words in found.message


def test_a_number_in_a_formula() -> None:
    assert rendered(r"$x = \calc{-1 / 3:.2f}$") == rendered("$x = -0.33$")
    assert rendered(r"$x = \calc{0.002:.0e}$") == rendered(r"$x = 2 \cdot 10^{-3}$")
    assert rendered(r"$\calc{12000:,.0f}$") == rendered(r"$12\,000$")
