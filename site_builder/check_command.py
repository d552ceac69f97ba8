"""``python -m site_builder check``: all that is wrong with the sources, for people, editors and
programs. What it finds in order, the build builds."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace

from site_builder.browser_python import pack_for_browser
from site_builder.build import Options, check_site
from site_builder.checks.outside_links import check_outside_links, outside_links
from site_builder.diagnostic_formats import listed
from site_builder.diagnostics import BuildError, Diagnostic, counted


@dataclass(frozen=True, slots=True)
class Wanted:
    """What an author asks for."""

    form: str = "text"
    """One of `diagnostic_formats.FORMATS`."""
    links: bool = False
    """Whether to follow links out of the book."""


def check(options: Options, wanted: Wanted) -> int:
    """Print what is found; 1 where there is a mistake, else 0.

    In words, mistakes and warnings go to the standard error, as the build's do; what is for
    programs goes to the standard output, whole.
    """
    found = find(options, links=wanted.links)
    warnings = [one for one in found if not one.fails]
    mistakes = [one for one in found if one.fails]
    if wanted.form != "text":
        sys.stdout.write(listed(found, options.root, wanted.form))
        return int(bool(mistakes))
    sys.stderr.write(listed([*warnings, *mistakes], options.root, "text"))
    if mistakes:
        print(f"{counted(mistakes, 'mistake')}; nothing was written", file=sys.stderr)
        return 1
    print("no mistakes" + (f"; {counted(warnings, 'warning')}" if warnings else ""))
    return 0


def find(options: Options, *, links: bool = False) -> Sequence[Diagnostic]:
    """Mistakes and warnings in the order of files and lines."""
    found: list[Diagnostic] = []
    try:
        book, *_ = check_site(replace(options, warn=found.append))
        if options.runtime:
            pack_for_browser(options.root, book, compiled=False)
        if links:
            found += check_outside_links(outside_links(book))
    except BuildError as error:
        found += error.diagnostics
    return sorted(set(found))
