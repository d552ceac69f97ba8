"""What follows from the values that declare directives and roles: checks, templates."""

from collections import Counter

from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.fences import OPENING
from site_builder.markdown.role import USE
from site_builder.markdown.roles import ROLES
from site_builder.pages.environment import TEMPLATES


def test_every_template_of_a_block_belongs_to_a_directive_or_to_prose() -> None:
    files = {file.stem for file in (TEMPLATES / "blocks").iterdir()}
    assert files == {"prose"} | {directive.template for directive in DIRECTIVES}


def test_names_are_given_once_and_can_be_written() -> None:
    directives = Counter(directive.name for directive in DIRECTIVES)
    roles = Counter(role.name for role in ROLES)
    assert max(*directives.values(), *roles.values()) == 1
    assert all(OPENING.fullmatch(f":::{{{name}}} words") for name in directives)
    assert all(USE.fullmatch(f"{{{name}}}`words`") for name in roles)
