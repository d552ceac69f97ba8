"""The marks in the plane of the square: P, its image, and the corners."""

from collections.abc import Iterator

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography, sign_of_w
from simulations.scenes._mapped_square import family
from simulations.scenes._mapped_square.plane import HEIGHT, WIDTH, from_view, in_frame, to_view
from simulations.scenes._mapped_square.square import SQUARE

CLEAR = 15.0
"""Distance from a point to its label, in view box units, with space for a handle between."""
LETTER = 8.2
"""Largest width of a letter of a label."""


def point_and_image(H: Floats, way: Floats, point: Floats) -> str:
    """P, its image P′ and their coordinates.

    ``way`` (N, 3, 3) are the matrices of all amounts: P′ slides along a curve, of which the part on
    its side of infinity is drawn. Without any there is no curve.
    """
    before = to_view(point)
    image, valid = apply_homography(H, point)
    parts = [drawing.path(_track(way, point, H), "image thin faint")] if len(way) else []
    torn = sign_of_w(H, point) != sign_of_w(H, (0.0, 0.0))
    after = in_frame(image[None], closed=False) if valid else np.empty((0, 2))
    if len(after):
        if not torn:
            parts.append(drawing.line(before, after[0], "image thin dashed"))
        parts.append(drawing.dot(after[0], "image", 4.5))
        parts.append(_coordinates("P′", image, after[0]))
    parts.append(drawing.dot(before, "world", 4.5))
    parts.append(_name("P", before))
    return "".join(parts)


def _track(way: Floats, point: Floats, H: Floats) -> list[Floats]:
    """Runs of places (n, 2) of P′ on its side of infinity, interrupted where it is out of view."""
    images, w = _images(way, point)
    places = to_view(images)
    seen = np.all((places >= -4.0) & (places <= [WIDTH + 4.0, HEIGHT + 4.0]), axis=1)
    seen &= np.sign(w) == sign_of_w(H, point)
    parted = np.flatnonzero(np.diff(seen)) + 1
    runs = zip(np.split(places, parted), np.split(seen, parted), strict=True)
    return [run for run, visible in runs if visible[0] and len(run) > 1]


def _name(name: str, place: Floats) -> str:
    """The name of a point, above it on its left, or on its right at the left border."""
    x, y = place
    near = x < 2.0 * CLEAR
    at = (x + (CLEAR if near else -CLEAR), y - 9.0 if y > 26.0 else y + 17.0)
    return drawing.text(at, name, "world ground strong", "start" if near else "end")


def _coordinates(name: str, point: Floats, place: Floats) -> str:
    """Name and coordinates of an image, on its right, or at the right border and farther from its
    row; away from the axis, on the side that its square is not on."""
    x, y = (format_number(float(value), 1) for value in point)
    words = f"{name} ({x}, {y})"
    last = WIDTH - CLEAR - LETTER * len(words)
    above = place[1] > 26.0 and (point[1] >= 0.0 or place[1] > HEIGHT - 26.0)
    aside = CLEAR + 10.0 * (place[0] > last)
    row = place[1] + 4.0 - aside if above else min(place[1] + aside, HEIGHT - 6.0)
    corner = (min(place[0], last) + CLEAR, row)
    return drawing.text(corner, words, "image ground strong")


def corners(kind: str, H: Floats) -> Iterator[str]:
    """Images of the corners that a pull keeps fixed, as pins; the one to pull, solid."""
    images, valid = apply_homography(H, SQUARE)
    fixed = family.FIXED[kind]
    for index, place in enumerate(to_view(images)):
        if not valid[index] or not _in_view(place):
            continue
        if index == family.PULLED:
            yield _square(place, 5.0, "image solid")
        elif index in fixed:
            yield _square(place, 4.0, "image solid faint")


def _in_view(place: Floats) -> bool:
    return bool(np.all(place >= 0.0) and place[0] <= WIDTH and place[1] <= HEIGHT)


def _square(place: Floats, half: float, style: str) -> str:
    return drawing.rectangle(place - half, 2.0 * half, 2.0 * half, style)


def nearest_amount(way: Floats, point: Floats, place: drawing.Point) -> int:
    """The index of the matrix of ``way`` (N, 3, 3) that maps ``point`` nearest to a place."""
    off = _images(way, point)[0] - from_view(place)
    return int(np.nanargmin((off * off).sum(axis=1)))


def _images(way: Floats, point: Floats) -> tuple[Floats, Floats]:
    """Images (N, 2) of one point under matrices (N, 3, 3), NaN at infinity, and its w (N,)."""
    images = way @ np.array([*point, 1.0])
    w = images[:, 2]
    return images[:, :2] / np.where(w == 0.0, np.nan, w)[:, None], w
