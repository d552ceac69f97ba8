"""``python -m site_builder check``: all that is wrong with the sources, for people, editors and
programs. What it finds in order, the build builds."""

import sys
from collections.abc import Sequence
from dataclasses import replace

from site_builder.browser_python import pack_for_browser
from site_builder.build import Options, check_site
from site_builder.diagnostic_formats import listed
from site_builder.diagnostics import BuildError, Diagnostic, counted


def check(options: Options, form: str) -> int:
    """Print the diagnostics in ``form``, one of `diagnostic_formats.FORMATS`; 1 where one is a
    mistake, else 0.

    Text goes to the standard error, as the build's does; formats for programs go to the standard
    output.
    """
    found = find(options)
    warnings = [one for one in found if not one.fails]
    mistakes = [one for one in found if one.fails]
    if form != "text":
        sys.stdout.write(listed(found, options.root, form))
        return int(bool(mistakes))
    sys.stderr.write(listed([*warnings, *mistakes], options.root, "text"))
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
            pack_for_browser(options.root, book, compiled=False)
    except BuildError as error:
        found += error.diagnostics
    return sorted(set(found))
