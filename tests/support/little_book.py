"""A little book, checked and rendered."""

from dataclasses import replace

from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics import BuildError, Diagnostic
from site_builder.output.assets import content_bytes

OUTLINE = 'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first", "01-second"]\n'
"""Of two chapters, and no figure on the cover."""
FRONT = "---\ntitle: First\nsummary: The first chapter.\n---\n"


def diagnostics(options: Options) -> list[Diagnostic]:
    """Warnings and mistakes."""
    found: list[Diagnostic] = []
    try:
        check_site(replace(options, warn=found.append))
    except BuildError as error:
        found += error.diagnostics
    return found


def rendered(options: Options) -> dict[str, bytes]:
    """The files of the site."""
    return {path: content_bytes(content) for path, content in render_site(options).items()}
