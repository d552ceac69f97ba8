"""Drawings as PNG, with the book's own faces: no browser, and the same bytes on every machine."""

from importlib.resources import files

import resvg_py

from site_builder.output.font_faces import FACES

SERIF, SANS = "Source Serif Pro", "Source Sans Pro"


def png_of(svg: str, width: int) -> bytes:
    """A drawing, ``width`` pixels wide. Raises `ValueError` where it is not a drawing."""
    return resvg_py.svg_to_bytes(
        svg_string=svg,
        width=width,
        skip_system_fonts=True,
        font_files=[str(files(face.package).joinpath(face.source)) for face in FACES],
        font_family=SERIF,
        serif_family=SERIF,
        sans_serif_family=SANS,
    )
