"""Numbers of the square's image: its area, and the image of the point P."""

import math

import numpy as np

from simulations.engine.frame import Readout, format_number, readout
from simulations.models.arrays import Floats
from simulations.models.geometry import transforms
from simulations.scenes._mapped_square.plane import image_of
from simulations.scenes._mapped_square.square import SQUARE


def area_ratio(H: Floats) -> float:
    """Area of the square's image over that of the square; infinite if it is cut."""
    image = image_of(H, SQUARE)
    return math.inf if image.cut else area(image.points) / area(SQUARE)


def area(polygon: Floats) -> float:
    """Area by the shoelace formula."""
    x, y = polygon[:, 0], polygon[:, 1]
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def point_readouts(H: Floats, point: Floats) -> tuple[Readout, ...]:
    """The image of P, and the divisor w."""
    image, valid = transforms.apply_homography(H, point)
    w = float(H[2] @ [*point, 1.0])
    if not valid:
        nowhere = ("x", "y")
        gone = tuple(
            Readout(name, f"{name}′ of P′", "at infinity", "", "image") for name in nowhere
        )
        return (*gone, readout("w", "w at P", w, digits=3))
    x, y = (float(value) for value in image)
    return (
        readout("x", "x′ of P′", x, digits=1, role="image"),
        readout("y", "y′ of P′", y, digits=1, role="image"),
        readout("w", "w at P", w, digits=3),
    )


def describe_point(H: Floats, point: Floats) -> str:
    """The image of P, in words."""
    here = coordinates(point, 0)
    image, valid = transforms.apply_homography(H, point)
    return f"P at {here} goes to {coordinates(image, 1) if valid else 'infinity'}."


def coordinates(point: Floats, digits: int) -> str:
    x, y = (format_number(float(value), digits) for value in point)
    return f"({x}, {y})"
