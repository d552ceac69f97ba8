"""``python -m site_builder check``: all mistakes in the sources, as text or as JSON."""

import sys
from collections.abc import Sequence
from dataclasses import replace

from site_builder.browser_python import pack_for_browser
from site_builder.build import Options, check_site
from site_builder.diagnostic_json import as_json
from site_builder.diagnostics import BuildError, Diagnostic, counted


def check(options: Options, *, json: bool) -> int:
    """Print the diagnostics; 1 where one is a mistake, else 0.

    Text goes to the standard error, as the build's does, and JSON to the standard output.
    """
    found = find(options)
    warnings = [one for one in found if not one.fails]
    mistakes = [one for one in found if one.fails]
    if json:
        sys.stdout.write(as_json(found, options.root))
        return int(bool(mistakes))
    for one in [*warnings, *mistakes]:
        print(one, file=sys.stderr)
    if mistakes:
        print(f"{counted(mistakes, 'mistake')}; nothing was written", file=sys.stderr)
        return 1
    print("no mistakes" + (f"; {counted(warnings, 'warning')}" if warnings else ""))
    return 0


def find(options: Options) -> Sequence[Diagnostic]:
    """Mistakes and warnings in the order of files and lines."""
    found: list[Diagnostic] = []
    try:
        book, *_ = check_site(replace(options, warn=found.append))
        if options.runtime:
            pack_for_browser(options.root, book, found.append, compiled=False)
    except BuildError as error:
        found += error.diagnostics
    return sorted(set(found))
