"""One style sheet in place of a tree of imports: a browser fetches each ``@import`` in turn."""

import re
from collections.abc import Mapping
from pathlib import PurePosixPath

from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.output.assets import Content, content_bytes

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
