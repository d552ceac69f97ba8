"""The site's icon for what shows no SVG: older browsers, and the home screens of phones."""

from collections.abc import Mapping
from pathlib import Path

from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.files.engine import own_or_engine
from site_builder.publishing.vector import png_of, whole_fonts

FILE = "static/images/favicon.svg"
SIZES = {"images/favicon.png": 32, "images/touch-icon.png": 180}
"""File among the assets to its width in pixels."""


def make_icons(root: Path) -> Mapping[str, bytes]:
    """From the book's icon, or the engine's. Raises `BuildError` where it is no drawing."""
    file = own_or_engine(root, FILE)
    try:
        return _drawn(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BuildError([Diagnostic(FILE, 1, f"{error}; legal: a drawing in SVG")]) from error


@cached
def _drawn(svg: str) -> dict[str, bytes]:
    fonts = whole_fonts()
    return {name: png_of(svg, width, fonts) for name, width in SIZES.items()}
