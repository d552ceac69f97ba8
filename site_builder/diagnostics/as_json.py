"""Diagnostics as JSON, for programs. The text, ``file:line: message``, is `Diagnostic`'s own."""

import json
import re
from collections.abc import Sequence
from pathlib import Path

from site_builder.diagnostics.diagnostic import Diagnostic

SUGGESTION = re.compile(r"(?:.*; )?(?:did you mean (.*)\?|(?:legal|better): (.*))", re.DOTALL)
QUOTED = re.compile(r"'((?:[^'\\]|\\.)+)'")


def as_json(found: Sequence[Diagnostic], root: Path) -> str:
    """``{"mistakes": 1, "warnings": 0, "diagnostics": […]}``; the fields of a diagnostic are
    ``file``, ``line``, ``column`` (or null), ``severity`` (``error`` or ``warning``), ``message``,
    and ``suggestion`` (or null). Fields may be added, none is changed."""
    mistakes = sum(one.fails for one in found)
    table = {
        "mistakes": mistakes,
        "warnings": len(found) - mistakes,
        "diagnostics": [
            {
                "file": one.path,
                "line": one.line,
                "column": column_of(one, root),
                "severity": "error" if one.fails else "warning",
                "message": one.message + (f" (met at {one.met})" if one.met else ""),
                "suggestion": suggestion_of(one.message),
            }
            for one in found
        ],
    }
    return json.dumps(table, ensure_ascii=False, indent=1) + "\n"


def suggestion_of(message: str) -> str | None:
    """The correction that a message proposes: the nearest name, or all that is legal."""
    match = SUGGESTION.match(message)
    return (match[1] or match[2]).strip() if match else None


def column_of(diagnostic: Diagnostic, root: Path) -> int | None:
    """The column, from 1, of what the message quotes first; None where its line does not hold it
    exactly once."""
    quoted = QUOTED.search(diagnostic.message)
    if quoted is None:
        return None
    try:
        lines = (root / diagnostic.path).read_text("utf-8", errors="replace").split("\n")
    except OSError:
        return None
    line = lines[diagnostic.line - 1] if 0 < diagnostic.line <= len(lines) else ""
    return line.index(quoted[1]) + 1 if line.count(quoted[1]) == 1 else None
