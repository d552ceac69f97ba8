"""One style sheet in place of a tree of imports: a browser fetches each ``@import`` in turn."""

import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.document.book import Colours
from site_builder.files.engine import own_or_engine
from site_builder.output.assets import Content, content_bytes

LIT_OTHERWISE = ".handle, .readout"
"""Selects what a lit idea marks in another way than by its ground."""


def colour_rules(colours: Colours) -> str:
    """What ``tokens.css``, ``overlay.css``, ``readouts.css`` and ``tools.css`` say of a role."""
    return "".join(
        f"""
:root {{ --idea-{name}: light-dark({light}, {dark}); }}
.overlay .{name}, .role-{name} {{ color: var(--idea-{name}); }}
.readout.role-{name} {{ --mark: var(--idea-{name}); }}
simulation-figure[data-lit="{name}"] .overlay > :not(.{name}, :has(.{name})) {{ opacity: 0.25; }}
[data-lit="{name}"] .role-{name}:not({LIT_OTHERWISE}) {{
  border-radius: var(--radius);
  background: color-mix(in srgb, currentColor 14%, transparent);
}}
[data-lit="{name}"] .readout.role-{name} {{ border-top-color: var(--mark); }}
"""
        for name, (light, dark) in colours.items()
    )


def paper_rules(colours: Colours) -> str:
    """The same without variables and themes, for e-books and notebooks."""
    return "".join(
        f".overlay .{name}, .role-{name} {{ color: {light}; }}\n"
        for name, (light, _) in colours.items()
    )


TOKEN = re.compile(r"^  (--[\w-]+): light-dark\(([^,]+), [^)]+\);", re.MULTILINE)
CONTAINER = re.compile(r"^@container (?:.*\n)*?\}\n", re.MULTILINE)


def style_of_drawings(root: Path, more: str, families: Mapping[str, str], colours: Colours) -> str:
    """The site's sheet for drawings and ``more`` rules, in plain CSS. ``root`` is the book's
    folder, ``families`` are the faces by the names of their variables, ``colours`` the book's."""
    tokens, overlay = (
        own_or_engine(root, f"static/css/{name}.css").read_text(encoding="utf-8")
        for name in ("tokens", "overlay")
    )
    rules = without_containers(overlay) + more + paper_rules(colours)
    return resolve(rules, light_tokens(tokens) | dict(families))


def light_tokens(sheet: str) -> dict[str, str]:
    """The colours of the light theme, by the name of their variable."""
    return dict(TOKEN.findall(sheet))


def resolve(sheet: str, tokens: dict[str, str]) -> str:
    """Without variables. Raises `KeyError` for one that is not a token."""
    return re.sub(r"var\((--[\w-]+)\)", lambda found: tokens[found[1]], sheet)


def without_containers(sheet: str) -> str:
    """Without what depends on the width of a place in the page."""
    return CONTAINER.sub("", sheet)


COMMENT = re.compile(r"""("(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')|/\*.*?\*/""", re.DOTALL)
"""A comment; or a string, in which there is none."""
IMPORT = re.compile(r'^@import "([^"]+)";\n', re.MULTILINE)


def join_style_sheets(
    files: Mapping[str, Content], entry: str, more: str = ""
) -> dict[str, Content]:
    """``files`` with the sheet ``entry`` holding, in order, what it imports from its own folder,
    and ``more`` at its end.

    The imported sheets are left out. Raises `BuildError` where one is missing or lies in another
    folder, where its relative addresses would be wrong.
    """
    sheet = content_bytes(files[entry]).decode("utf-8")
    folder = PurePosixPath(entry).parent
    taken = {found[1]: str(folder / found[1]) for found in IMPORT.finditer(sheet)}
    wrong = [name for name, path in taken.items() if "/" in name or path not in files]
    if wrong:
        raise BuildError(_mistake(sheet, name, entry) for name in wrong)
    rest = {path: content for path, content in files.items() if path not in taken.values()}

    joined = IMPORT.sub(lambda found: content_bytes(files[taken[found[1]]]).decode("utf-8"), sheet)
    return {**rest, entry: (joined + more).encode("utf-8")}


def without_comments(sheet: str) -> str:
    """A sheet as it is sent inside a page: without what only its authors read.

    >>> without_comments('a { /* red */\\n  content: "/* b */";\\n}')
    'a { \\ncontent: "/* b */";\\n}'
    """
    bare = COMMENT.sub(lambda found: found[1] or "", sheet)
    return re.sub(r"\n\s+", "\n", bare)


def _mistake(sheet: str, name: str, entry: str) -> Diagnostic:
    line = sheet[: sheet.index(f'"{name}"')].count("\n") + 1
    return Diagnostic(
        f"static/{entry}", line, f"cannot import {name!r}; legal: a style sheet beside this one"
    )
