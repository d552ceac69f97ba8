"""Chapters of the guide that are made of declarations: what there is stands in them, and nothing
else can."""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from site_builder.markdown.directive import Directive, OptionLine
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.questions.kinds import KINDS
from site_builder.markdown.role import Role
from site_builder.markdown.roles import ROLES
from site_builder.settings.model import settings_table

MEASURED = """\
## Colours that are measured

Where a colour is the result, `swatch` of `simulations/engine/drafting.py` fills a rectangle \
with it, the same on every paper; its class is `swatch`. What is drawn upon it is `on-swatch`. \
In the words of `label`, there too, `_` lowers what follows and `^` raises it: those parts are \
`sub` and `super`.
"""
BAR = "\\|"
"""A bar inside a table."""
EXAMPLES = Path(__file__).with_name("examples")


class NoExampleError(LookupError):
    """A declaration without an example; the message names the file to write."""


def directive_page(directives: Sequence[Directive[Any]] = DIRECTIVES) -> str:
    """A section for each directive: what it makes, its options, an example and what comes of it."""
    written = read_examples(EXAMPLES)
    for name in ("quiz", "predict"):
        own = [written[name]] if name in written else []
        written[name] = "\n\n".join([*own, *question_examples(name)])
    names = [item.name for item in directives]
    parts = [_directive_section(item, written, names) for item in directives]
    return _chapter(
        "Directives",
        "Every block with a meaning of its own, its options, and an example that is built here.",
        "A directive begins with `:::{name}` and ends at `:::`. Options stand directly below its "
        "first line. One that holds another is fenced by one colon more.",
        parts,
    )


def role_page(roles: Sequence[Role] = ROLES, examples: Path = EXAMPLES) -> str:
    """A section for each role."""
    written = read_examples(examples)
    return _chapter(
        "Roles",
        "What stands within a sentence: references, terms, numbers that models compute, colours.",
        "A role is written ``{name}`words` ``.",
        [_role_section(role, written) for role in roles],
    )


def drawing_page(roles: Sequence[str], manners: Mapping[str, str], texts: Sequence[str]) -> str:
    """The colour roles and the classes of drawings; ``manners`` with how they look."""
    colours = "".join(f"| `{name}` | {{{name}}}`so` |\n" for name in roles)
    looks = "".join(f"| `{name}` | `{look}` |\n" for name, look in manners.items())
    words = ", ".join(f"`{name}`" for name in texts)
    return _chapter(
        "Drawings",
        "The colour roles, one for each idea, and the classes that say how a line is drawn.",
        "A drawing never names a colour. Each mark has the role of its idea, the same in figures, "
        "formulae and sentences, and if need be a manner; the style sheet does the rest, on light "
        "paper and on dark.\n\n"
        ":::{illustration} marks\nEach role and each manner, drawn by a function of "
        "`simulations/illustrations/`.\n:::",
        [
            f"## Roles of colour\n\n| Role | In a sentence |\n|---|---|\n{colours}",
            f"## Manners\n\n| Class | Looks |\n|---|---|\n{looks}\nLabels may also be {words}.\n",
            MEASURED,
        ],
    )


def settings_page() -> str:
    """The keys of ``book.toml``."""
    return _chapter(
        "Settings",
        "Every key of content/book.toml, what it sets, and what holds without it.",
        "A key that is not in this table, or a value of another kind, is a mistake with its line.",
        [f"## The keys\n\n{settings_table()}\n"],
    )


def read_examples(folder: Path) -> dict[str, str]:
    """The examples by the names of their files."""
    files = sorted(folder.glob("*.md"))
    return {file.stem: file.read_text(encoding="utf-8").strip() for file in files}


def question_examples(directive: str) -> list[str]:
    """Names of the kinds of questions that this directive asks, or asks first."""
    return [
        kind.file("md").read_text(encoding="utf-8").strip()
        for kind in KINDS
        if directive == ("quiz" if kind.quiz else "predict")
    ]


def _kinds_of_questions(directive: str) -> str:
    rows = (
        f"| {' or '.join(f'`{name}`' for name in names)} | {kind.doc} |\n"
        for kind in KINDS
        if (names := kind.names(directive))
    )
    return f"| Kind | Is |\n|---|---|\n{''.join(rows)}"


def _directive_section(
    item: Directive[Any], written: Mapping[str, str], names: Sequence[str]
) -> str:
    argument = f" {item.argument.form}" if item.argument else ""
    parts = [
        f"## {item.name}\n",
        f"Makes {item.doc}. Between its fences: {item.body.doc}.\n",
        f"```text\n:::{{{item.name}}}{argument}\n```\n",
    ]
    if item.options or item.more_options:
        parts.append(_options(item.options, item.more_options))
    if item.name in ("quiz", "predict"):
        parts.append(_kinds_of_questions(item.name))
    within = next((name for name in names if _uses(item.name, written.get(name, ""))), "")
    if item.name in written:
        parts.append(_shown(written[item.name]))
    elif within:
        parts.append(f"The example of [{within}](#{within}) has it.\n")
    else:
        raise NoExampleError(
            f"directive {item.name!r} has no example; legal: site_builder/guide/examples/"
            f"{item.name}.md, or a use of it in another file there"
        )
    return "\n".join(parts)


def _role_section(role: Role, written: Mapping[str, str]) -> str:
    example = written.get(f"role-{role.name}")
    if example is None:
        if role.text or role.link or role.inline:
            raise NoExampleError(
                f"role {role.name!r} has no example; legal: site_builder/guide/examples/"
                f"role-{role.name}.md"
            )
        example = f"The words {{{role.name}}}`in its colour`."
    form = role.form.replace("|", BAR)
    return f"## {role.name}\n\nMakes {role.doc}. It holds `{form}`.\n\n{_shown(example)}"


def _options(options: Iterable[OptionLine], more: str) -> str:
    rows = "".join(_option(option) for option in options)
    rest = f"\nAlso: {more}.\n" if more else ""
    return f"| Option | Gives | Must be there |\n|---|---|---|\n{rows}{rest}" if rows else rest


def _option(option: OptionLine) -> str:
    expected = " or ".join(f"`{value}`" for value in option.expected)
    doc = f"{option.doc}: {expected}" if expected else option.doc
    return f"| `:{option.name}:` | {doc} | {'yes' if option.required else 'no'} |\n"


def _uses(name: str, example: str) -> bool:
    return re.search(rf"^:+\{{{re.escape(name)}\}}", example, re.MULTILINE) is not None


def _shown(example: str) -> str:
    """An example as it is written, then as it is read."""
    return f"````markdown\n{example}\n````\n\n{example}\n"


def _chapter(title: str, summary: str, opening: str, parts: Iterable[str]) -> str:
    body = "\n".join(parts)
    return f"---\ntitle: {title}\nsummary: '{summary}'\n---\n\n{opening}\n\n{body}"
