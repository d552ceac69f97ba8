"""One style sheet in place of a tree of imports: a browser fetches each ``@import`` in turn."""

import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from simulations.engine.frame import ROLES
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.document.book import Colours
from site_builder.files.engine import book_or_engine_file
from site_builder.output.writer import Content, content_bytes
from site_builder.settings.model import Theme

ENGINE_ROLES = (*ROLES[1:], "muted")
"""Roles whose colours are in ``tokens.css``."""
MEASURE_REM = 31 / 66
"""Width of a letter of the text, as in ``tokens.css``."""
LIT_OTHERWISE = ".handle, .readout"
"""Selects what a lit idea marks in another way than by its ground."""


def colour_rules(colours: Colours) -> str:
    """Rules of every role, the engine's and those of ``colours``, the book's own: in drawings,
    readouts and prose, and while it is lit."""
    values = "".join(
        f":root {{ --idea-{name}: light-dark({light}, {dark}); }}\n"
        for name, (light, dark) in colours.items()
    )
    variables = {name: f"--{name}" for name in ENGINE_ROLES}
    variables |= {name: f"--idea-{name}" for name in colours}
    return values + "".join(
        f"""
.overlay .{name}, .role-{name} {{ color: var({variable}); }}
.readout.role-{name} {{ --mark: var({variable}); }}
simulation-figure[data-lit="{name}"] .overlay {{
  > :not(.{name}, :has(.{name}), text.muted) {{ opacity: 0.25; }}
  > rect.ground {{ opacity: 0; }}
  > rect.ground:has(+ :is(.{name}, text.muted)) {{ opacity: 1; }}
}}
[data-lit="{name}"] .role-{name}:not({LIT_OTHERWISE}) {{
  border-radius: var(--radius);
  background: color-mix(in srgb, currentColor 14%, transparent);
}}
[data-lit="{name}"] .readout.role-{name} {{ border-top-color: var(--mark); }}
"""
        for name, variable in variables.items()
    )


def theme_rules(theme: Theme) -> str:
    """What a book has in place of the values of ``tokens.css``."""
    light, _, dark = theme.accent.partition(" ")
    values = {
        "accent": theme.accent and f"light-dark({light}, {dark})",
        "accent-wash": theme.accent and f"light-dark({light}14, {dark}1f)",
        "serif": theme.text and f'{theme.text}, "Book Maths", serif',
        "sans": theme.interface and f'{theme.interface}, "Book Maths", sans-serif',
        "mono": theme.code and f"{theme.code}, monospace",
        "measure": theme.width != 66 and f"{theme.width * MEASURE_REM:.2f}rem",
    }
    own = "".join(f"  --{name}: {value};\n" for name, value in values.items() if value)
    headings = f"#main :is(h1, h2, h3, h4) {{ font-family: {theme.headings}; }}\n"
    return f":root {{\n{own}}}\n" * bool(own) + headings * bool(theme.headings)


TOKEN = re.compile(r"^  (--[\w-]+): light-dark\(([^,]+), [^)]+\);", re.MULTILINE)
OF_FIGURES = re.compile(r"^simulation-figure (?:.*\n)*?\}\n", re.MULTILINE)


def style_of_drawings(root: Path, more: str, families: Mapping[str, str], colours: Colours) -> str:
    """The site's sheet for drawings and ``more`` rules, in plain CSS: in the light theme, without
    variables and what depends on the width of a place in the page.

    ``root`` is the book's folder, ``families`` are the faces by the names of their variables,
    ``colours`` the book's. Raises `KeyError` for a variable that is no token.
    """
    tokens, overlay = (
        book_or_engine_file(root, f"static/css/{name}.css").read_text(encoding="utf-8")
        for name in ("tokens", "overlay")
    )
    inks = {name: f"var(--{name})" for name in ENGINE_ROLES}
    inks |= {name: light for name, (light, _) in colours.items()}
    roles = "".join(
        f".overlay .{name}, .role-{name} {{ color: {ink}; }}\n" for name, ink in inks.items()
    )
    values = dict(TOKEN.findall(tokens)) | dict(families)
    rules = roles + OF_FIGURES.sub("", overlay) + more
    return re.sub(r"var\((--[\w-]+)\)", lambda found: values[found[1]], rules)


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
        lines = {name: sheet[: sheet.index(f'"{name}"')].count("\n") + 1 for name in wrong}
        message = "cannot import {!r}; legal: a style sheet beside this one"
        raise BuildError(
            Diagnostic(f"static/{entry}", line, message.format(name))
            for name, line in lines.items()
        )
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
