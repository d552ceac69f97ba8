"""``python -m site_builder guide``: write the guide as a book, then build or serve it.

Some chapters are generated from declarations, so they list exactly what exists.
"""

import ast
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from inspect import Parameter, cleandoc, getdoc, getsource, signature
from itertools import zip_longest
from pathlib import Path
from types import FunctionType
from typing import Any, cast

from simulations.engine.frame import ROLES as COLOUR_ROLES
from site_builder.files.engine import ENGINE, STATIC, book_or_engine_file
from site_builder.markdown.directive import Directive, OptionLine
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.questions.kinds import KINDS
from site_builder.markdown.role import Role
from site_builder.markdown.roles import ROLES
from site_builder.scaffold.pieces import GALLERY, SUFFIX, Name, filled, from_gallery
from site_builder.scaffold.pieces import HERE as SCAFFOLD
from site_builder.settings.model import settings_table

VERSION = re.compile(r"^## (.+)$", re.MULTILINE)
FOR_AUTHORS = re.compile(r"^### For authors$\n(.*?)(?=^### |\Z)", re.MULTILINE | re.DOTALL)
HEAD = """---
title: What changed
summary: What an author notices, by version of the builder.
---

The newest version comes first. What only readers notice is in the changelog of the builder.
"""


def changes_page(changelog: Path) -> str:
    """The sections ``For authors`` of a changelog, under the names of their versions."""
    _, *parts = VERSION.split(changelog.read_text(encoding="utf-8"))
    sections = [
        f"\n## {version}\n\n{found[1].strip().replace('#### ', '### ')}\n"
        for version, text in zip(parts[::2], parts[1::2], strict=True)
        if (found := FOR_AUTHORS.search(text))
    ]
    return HEAD + "".join(sections)


CLASS_RULE = re.compile(
    r"^\.overlay (text|rect)?\.([a-z]+)(?:,\n.+)* \{\n((?:  .*\n)+)\}", re.MULTILINE
)
UNSEEN = ("swatch",)
"""Classes of what has a colour of its own."""


type Names = tuple[str, ...]


def read_classes(overlay: Path) -> tuple[Names, dict[str, str], Names]:
    """Roles, manners with how they look, ``stroke-width: 1px``, and the classes of labels in the
    style sheet of drawings."""
    found = CLASS_RULE.findall(overlay.read_text(encoding="utf-8"))
    looks = {name: " ".join(body.split()).rstrip(";") for text, name, body in found if not text}
    manners = {name: look for name, look in looks.items() if name not in UNSEEN}
    texts = tuple(name for text, name, _ in found if text)
    return (*filter(None, COLOUR_ROLES), "muted"), manners, texts


ASKED = re.compile(r"^\[(api|gallery) (.+)\]$", re.MULTILINE)
"""Where a table or a figure stands in a page of the guide: ``[api frame:Panel drawing]``,
``[gallery pendulum]``."""


def api_table(*things: str) -> str:
    """A row for each function, class, field and method of modules of the engine that has
    documentation: how it is written, and that. ``things``: ``drafting``, ``drawing:line,dot``."""
    rows: list[str] = []
    for thing in things:
        module, _, wanted = f"simulations.engine.{thing}".partition(":")
        found = vars(import_module(module))
        own = (
            name
            for name, each in found.items()
            if isinstance(each, FunctionType | type) and each.__module__ == module
        )
        for name in wanted.split(",") if wanted else own:
            rows += _api_rows(found[name]) if not name.startswith("_") else ()
    return f"| Written | Is |\n|---|---|\n{''.join(rows)}"


def _api_rows(thing: Any) -> Iterator[str]:
    yield _api_row(f"{thing.__name__}({_parameters(thing)})", thing)
    if not isinstance(thing, type):
        return
    body = cast(ast.ClassDef, ast.parse(getsource(thing)).body[0]).body
    for entry, doc in zip_longest(body, body[1:]):
        match entry, doc:
            case ast.AnnAssign(ast.Name(name)), ast.Expr(ast.Constant(str(words))):
                yield _api_row(f".{name}", words)
            case ast.FunctionDef(name), _ if not name.startswith("_"):
                method = getattr(thing, name)
                given = f"({_parameters(method)})" if callable(method) else ""
                yield _api_row(f".{name}{given}", method)


def _api_row(written: str, thing: object) -> str:
    """The first paragraph of its documentation: ``thing`` is that itself, or has it."""
    doc = cleandoc(thing) if isinstance(thing, str) else getdoc(thing) or ""
    said = " ".join(doc.partition("\n\n")[0].split()).replace("``", "`")
    return f"| `{written.replace('|', BAR)}` | {said.replace('|', BAR)} |\n"


def _parameters(stated: Callable[..., object]) -> str:
    parameters = signature(stated).parameters.values()
    named = (each.replace(annotation=Parameter.empty) for each in parameters)
    return ", ".join(str(each) for each in named if each.name != "self")


def gallery_section(name: str) -> str:
    """A figure of the gallery, live, with its whole source."""
    caption = from_gallery(name).split('"""')[1]
    return (
        f":::{{simulation}} {name}\n{caption}\n:::\n\n"
        f":::{{source}} simulations.scenes.{Name(name).module}\n"
        f"`python -m site_builder new scene my-{name} --like {name}`\n:::\n"
    )


def with_parts(page: str) -> str:
    """The page with its tables and figures."""
    makers = {"api": lambda names: api_table(*names.split()), "gallery": gallery_section}
    return ASKED.sub(lambda asked: makers[asked[1]](asked[2]), page)


STEPS = """## In steps

A derivation is followed best as it grows. Give the marks of each step to `in_steps`, six steps \
at most. Below the caption, write a numbered list, one sentence for each step; the build tells you \
where their numbers differ. Readers press *Next step*, an arrow key or the drawing. On paper the \
whole drawing is shown, with all sentences.

:::{source} simulations.illustrations.mirror:draw
The marks of two steps.
:::

:::{illustration} mirror
Light at a mirror.

1. A ray meets the mirror.
2. It leaves at the same angle to the normal, on the other side.
:::
"""
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
        kinds = (kind for kind in KINDS if name == ("quiz" if kind.quiz else "predict"))
        texts = (kind.file("md").read_text(encoding="utf-8").strip() for kind in kinds)
        written[name] = "\n\n".join([*own, *texts])
    names = [item.name for item in directives]
    parts = [_directive_section(item, written, names) for item in directives]
    return _chapter(
        "Directives",
        "Every block with a meaning of its own, its options, and an example that is built here.",
        "A directive begins with `:::{name}` and ends at `:::`. Options stand directly below its "
        "first line. One that holds another is fenced by one colon more.",
        parts,
    )


def role_page() -> str:
    """A section for each role."""
    written = read_examples(EXAMPLES)
    return _chapter(
        "Roles",
        "What stands within a sentence: references, terms, numbers that models compute, colours.",
        "A role is written ``{name}`words` ``.",
        [_role_section(role, written) for role in ROLES],
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
            STEPS,
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
        parts.append(_source_and_result(written[item.name]))
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
    return (
        f"## {role.name}\n\nMakes {role.doc}. It holds `{form}`.\n\n{_source_and_result(example)}"
    )


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


def _source_and_result(example: str) -> str:
    """An example as it is written, then as it is read."""
    return f"````markdown\n{example}\n````\n\n{example}\n"


def _chapter(title: str, summary: str, opening: str, parts: Iterable[str]) -> str:
    body = "\n".join(parts)
    return f"---\ntitle: {title}\nsummary: '{summary}'\n---\n\n{opening}\n\n{body}"


OWN = Path(__file__).with_name("book")
TAKEN = "simulations/"
"""The folder that the guide takes from the template of a new book."""


def guide_files() -> dict[str, bytes]:
    """Every file of the guide by its path. Raises `NoExampleError`."""
    roles, manners, texts = read_classes(STATIC / "css" / "overlay.css")
    made = {
        "content/03-directives.md": directive_page(),
        "content/04-roles.md": role_page(),
        "content/05-drawings.md": drawing_page(roles, manners, texts),
        **{f"simulations/scenes/{Name(name).module}.py": from_gallery(name) for name in GALLERY},
        "content/08-settings.md": settings_page(),
        "content/11-changes.md": changes_page(book_or_engine_file(ENGINE, "CHANGELOG.md")),
        "simulations/models/classes.py": (
            f'"""Made by the guide."""\n\nROLES = {roles!r}\n'
            f"MANNERS = {tuple(manners)!r}\nTEXTS = {texts!r}\n"
        ),
    }
    new_book = {
        path: filled(f"book/{file.relative_to(SCAFFOLD / 'book').as_posix()}").encode()
        for file in sorted((SCAFFOLD / "book").rglob("*"))
        if file.is_file()
        for path in (file.relative_to(SCAFFOLD / "book").as_posix().removesuffix(SUFFIX),)
        if path.startswith(TAKEN)
    }
    own = {
        file.relative_to(OWN).as_posix().removesuffix(SUFFIX): file.read_bytes()
        for file in sorted(OWN.rglob("*"))
        if file.is_file()
    }
    pages = {name: with_parts(text.decode()) for name, text in own.items() if name.endswith(".md")}
    made |= pages
    return {**new_book, **own, **{path: text.encode() for path, text in made.items()}}


def write_guide(folder: Path) -> None:
    """Replace the contents of ``folder`` by the guide. Unchanged files are left alone, so that a
    server of the guide builds only what has changed."""
    files = guide_files()
    for old in sorted(folder.rglob("*")) if folder.is_dir() else ():
        if old.is_file() and old.relative_to(folder).as_posix() not in files:
            old.unlink()
    for path, data in files.items():
        file = folder / path
        if not file.is_file() or file.read_bytes() != data:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)


def run_guide(place: tuple[str, int] | None, *, runtime: bool) -> int:
    """Serve it at ``place``, host and port, or only build it; the exit code of that."""
    folder = Path("build", "guide").resolve()
    book, site = folder / "book", folder / "site"
    write_guide(book)
    how = ["serve", "--host", place[0], "--port", str(place[1])] if place else ["build"]
    command = [sys.executable, "-m", "site_builder", *how, "--out", str(site)]
    given = [] if runtime else ["--no-runtime"]
    environment = {**os.environ, "PYTHONPATH": str(ENGINE)}  # from the folder of another book
    return subprocess.run([*command, *given], cwd=book, env=environment, check=False).returncode
