"""What follows from the values that declare directives and roles: checks, templates."""

from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from simulations.registry import load_scene
from site_builder.diagnostics import Diagnostics
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import (
    Argument,
    Directive,
    DirectiveCall,
    OptionLine,
    OptionValue,
)
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.fences import OPENING
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.parser import make_parser
from site_builder.markdown.role import USE
from site_builder.markdown.roles import ROLES
from site_builder.markdown.usage import checked
from site_builder.pages.render import TEMPLATES

README = Path(__file__).parents[3] / "README.md"


@pytest.fixture
def context(tmp_path: Path) -> ParseContext:
    return ParseContext("a.md", Shared(tmp_path, load_scene, make_parser()), Diagnostics())


def film(**fields: Any) -> Directive[str]:
    """A directive that the book does not have."""
    declared = {
        "name": "film",
        "doc": "a moving picture",
        "argument": Argument("file"),
        "body": CAPTION,
        "read": lambda _use, caption, _reading: caption,
        "template": "film",
    }
    return Directive(**{**declared, **fields})


def use(argument: str = "", **options: str) -> DirectiveCall:
    values = {name: OptionValue(text, 2) for name, text in options.items()}
    return DirectiveCall("film", argument, values, 1)


def reported(context: ParseContext) -> list[str]:
    return [str(diagnostic) for diagnostic in context.problems.found]


def test_every_template_of_a_block_belongs_to_a_directive_or_to_prose() -> None:
    files = {file.stem for file in (TEMPLATES / "blocks").iterdir()}
    assert files == {"prose"} | {directive.template for directive in DIRECTIVES}


def test_names_are_given_once_and_can_be_written() -> None:
    directives = Counter(directive.name for directive in DIRECTIVES)
    roles = Counter(role.name for role in ROLES)
    assert max(*directives.values(), *roles.values()) == 1
    assert all(OPENING.fullmatch(f":::{{{name}}} words") for name in directives)
    assert all(USE.fullmatch(f"{{{name}}}`words`") for name in roles)


@pytest.mark.parametrize(
    ("argument", "given", "report"),
    [
        (Argument("file"), "", None),
        (Argument("file", lacks="names no file"), "a.webm", None),
        (
            Argument("file", lacks="names no file"),
            "",
            "{film} names no file; legal: ':::{film} file'",
        ),
        (Argument("kind", expected=("dots", "bars"), kind="film"), "dots", None),
        (
            Argument("kind", expected=("dots", "bars"), kind="film"),
            "bras",
            "unknown film 'bras'; did you mean 'bars'?",
        ),
        (Argument("kind", expected=("dots",), kind="film"), "", "unknown film ''; legal: dots"),
        (None, "", None),
        (None, "a", "{film} with an argument, 'a'; legal: ':::{film}', no more"),
    ],
)
def test_an_argument_is_what_its_directive_says(
    context: ParseContext, argument: Argument | None, given: str, report: str | None
) -> None:
    expected = checked(film(argument=argument), use(given), context)
    assert (expected is None) is (report is not None)
    assert reported(context) == ([f"a.md:1: {report}"] if report else [])


def test_options_are_what_their_directive_says(context: ParseContext) -> None:
    declared = film(
        options=(
            OptionLine("speed", doc="how fast", expected=("slow", "fast")),
            OptionLine("alt", doc="what it shows", required=True),
        )
    )
    expected = checked(declared, use(alt="Dots."), context)
    assert expected is not None
    given = (expected.text("speed"), expected.text("alt"), expected.text("other"))
    assert given == ("slow", "Dots.", "")
    assert reported(context) == []
    expected = checked(declared, use(speed="fsat", spede="fast"), context)
    assert expected is not None
    assert expected.text("speed") == "slow"
    assert reported(context) == [
        "a.md:2: unknown speed of film 'fsat'; did you mean 'fast'?",
        "a.md:2: unknown option of {film} 'spede'; did you mean 'speed'?",
        "a.md:1: {film} has no ':alt:'; legal: what it shows",
    ]
