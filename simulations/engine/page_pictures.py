"""Photographs as the page hands them over to its Python."""

import json
from typing import Any

import numpy as np

from simulations.engine.exif import exif_facts
from simulations.engine.photograph import Mosaic, Photograph


def photograph_from_page(picture: Any) -> Photograph:
    """A picture as the page hands it over: an object of JavaScript.

    Its fields are ``number``, ``name``, ``width`` and ``height``, the ``full_width`` and
    ``full_height`` before it was scaled down, ``draw``, which fills an array with its codes, and
    ``head``, the first bytes of the file; those of a raw file also ``facts``, JSON in place of the
    head's, and where wanted ``mosaic``.
    """
    codes = np.empty((picture.height, picture.width, 3), np.uint8)
    picture.draw(codes)
    full = {"full_width": picture.full_width, "full_height": picture.full_height}
    told = getattr(picture, "facts", None)
    return Photograph(
        picture.number,
        codes,
        picture.name,
        {**(json.loads(told) if told else exif_facts(picture.head.to_bytes())), **full},
        _mosaic(getattr(picture, "mosaic", None)),
    )


def _mosaic(given: Any) -> Mosaic | None:
    """Its fields are ``codes`` (two bytes each), their ``width`` and ``height``, and ``about``."""
    if given is None:
        return None
    codes = np.frombuffer(given.codes.to_bytes(), "<u2").reshape(given.height, given.width)
    about = json.loads(given.about)
    first, second, third, fourth = map(float, about["black"])
    black = (first, second, third, fourth)
    return Mosaic(codes, about["colours"], black, int(about["white"]))
