"""The lists of directives and roles in the author's guide, ``README.md``.

``python -m site_builder.markdown.guide`` prints them; a test holds the guide to them.
"""

from collections.abc import Iterable
from itertools import groupby
from typing import Any

from site_builder.markdown.directive import Argument, Directive, OptionLine
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.role import Role
from site_builder.markdown.roles import ROLES

BAR = "\\|"
"""A bar inside a table."""


def guide() -> str:
    """Two tables in Markdown: directives, then roles."""
    return f"{directive_table(DIRECTIVES)}\n{role_table(ROLES)}"


def directive_table(directives: Iterable[Directive[Any]]) -> str:
    rows = (
        f"| `:::{{{item.name}}}{_argument(item.argument)}` | {item.says} | {_options(item)} "
        f"| {item.body.says} |\n"
        for item in directives
    )
    return "| Directive | Makes | Options | Body |\n|---|---|---|---|\n" + "".join(rows)


def role_table(roles: Iterable[Role]) -> str:
    """Roles that differ only in their names share a line."""
    families = groupby(roles, key=lambda role: (role.form, role.says))
    rows = (
        f"| {', '.join(f'`{role.name}`' for role in family)} "
        f"| `{form.replace('|', BAR)}` | {says} |\n"
        for (form, says), family in families
    )
    return "| Role | Words | Makes |\n|---|---|---|\n" + "".join(rows)


def _argument(argument: Argument | None) -> str:
    if argument is None:
        return ""
    return f" {argument.form}" if argument.required else f" [{argument.form}]"


def _options(directive: Directive[Any]) -> str:
    words = [_option(option) for option in directive.options]
    return "; ".join([*words, *filter(None, [directive.more_options])])


def _option(option: OptionLine) -> str:
    legal = " or ".join(f"`{value}`" for value in option.legal)
    words = f"{option.says}, {legal}" if legal else option.says
    return f"`:{option.name}:` {words}{' (required)' if option.required else ''}"


if __name__ == "__main__":
    print(guide(), end="")
