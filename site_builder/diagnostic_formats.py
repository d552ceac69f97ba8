"""Diagnostics as programs read them: JSON, and the commands that a hosted check shows beside the
changed lines. What people and editors read, ``file:line: message``, is `Diagnostic`'s own form."""

import json
import re
from collections.abc import Sequence
from pathlib import Path

from site_builder.diagnostics import Diagnostic

FORMATS = ("text", "json", "github")
SUGGESTION = re.compile(r"(?:.*; )?(?:did you mean (.*)\?|(?:legal|better): (.*))", re.DOTALL)
QUOTED = re.compile(r"'((?:[^'\\]|\\.)+)'")


def listed(found: Sequence[Diagnostic], root: Path, form: str) -> str:
    """All of ``found`` in one of `FORMATS`, ending in a newline where there is anything."""
    match form:
        case "json":
            return as_json(found, root)
        case "github":
            return "".join(f"{_annotation(one, root)}\n" for one in found)
        case _:
            return "".join(f"{one}\n" for one in found)


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
                "severity": _severity(one),
                "message": one.message,
                "suggestion": suggestion_of(one.message),
            }
            for one in found
        ],
    }
    return json.dumps(table, ensure_ascii=False, indent=1) + "\n"


def suggestion_of(message: str) -> str | None:
    """What a message says would be right: the nearest name, or all that is legal."""
    match = SUGGESTION.match(message)
    return (match[1] or match[2]).strip() if match else None


def column_of(diagnostic: Diagnostic, root: Path) -> int | None:
    """Where in its line stands what the message quotes first, counted from 1; None where it does
    not, or stands twice."""
    quoted = QUOTED.search(diagnostic.message)
    if quoted is None:
        return None
    try:
        lines = (root / diagnostic.path).read_text("utf-8", errors="replace").splitlines()
    except OSError:
        return None
    line = lines[diagnostic.line - 1] if 0 < diagnostic.line <= len(lines) else ""
    return line.index(quoted[1]) + 1 if line.count(quoted[1]) == 1 else None


def _severity(diagnostic: Diagnostic) -> str:
    return "error" if diagnostic.fails else "warning"


def _annotation(one: Diagnostic, root: Path) -> str:
    """``::error file=F,line=1,col=3::message``, what may not stand there written in hexadecimal."""
    column = column_of(one, root)
    place = f"file={_property(one.path)},line={one.line}" + (f",col={column}" if column else "")
    return f"::{_severity(one)} {place}::{_data(one.message)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
