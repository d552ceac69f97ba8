"""The circle of confusion: the sensor cuts a near point's cone before its tip."""

from collections.abc import Iterator

from simulations.engine.drafting import dimension, glass, label
from simulations.engine.drawing import dot, line, polygon, polyline
from simulations.engine.illustration import Illustration, Panel, in_steps
from simulations.models.lens.thin_lens import (
    circle_of_confusion_mm,
    principal_distance_mm,
    thin_lens_image_distance,
)

LENS, AXIS = 214.0, 118.0
FOCAL, F_NUMBER, FOCUS, NEAR = 66.0, 0.74, 190.0, 128.0
"""All lengths are in units of the drawing, as millimetres."""
HALF = FOCAL / F_NUMBER / 2


def tip() -> float:
    """The point where the light of the near point meets."""
    return float(thin_lens_image_distance(FOCAL, NEAR))


def sensor() -> float:
    return principal_distance_mm(FOCAL, FOCUS)


def disc() -> float:
    return float(circle_of_confusion_mm(FOCAL, F_NUMBER, FOCUS, NEAR))


def _focused() -> Iterator[str]:
    """The lens, and the sensor where the far point is sharp."""
    place = LENS + sensor()
    yield line((6, AXIS), (394, AXIS), "muted thin dashed")
    for sign in (-1, 1):
        rim = (LENS, AXIS + sign * HALF)
        yield polyline([(LENS - FOCUS, AXIS), rim, (place, AXIS)], "ray thin")
        yield line(rim, (LENS, AXIS + sign * (HALF + 24)), "camera bold")
    yield glass((LENS, AXIS), HALF, 8)
    yield line((place, AXIS - 76), (place, AXIS + 76), "image bold")
    yield dot((LENS - FOCUS, AXIS), "ray", 5)
    yield dimension((LENS - FOCUS, 244), (LENS, 244), "ray")
    yield dimension((LENS, 212), (place, 212), "image")
    yield label((LENS - FOCUS / 2 - 30, 239), "s", "ray italic", "middle")
    yield label((LENS + sensor() / 2, 207), "z_s", "image italic", "middle")
    yield label((place, AXIS - 84), "sensor", "image", "middle")
    yield label((LENS, AXIS - HALF - 32), "lens", "camera", "middle")


def _near() -> Iterator[str]:
    """The near point's light, and where it would meet."""
    end = (LENS + tip(), AXIS)
    for sign in (-1, 1):
        rim = (LENS, AXIS + sign * HALF)
        yield polyline([(LENS - NEAR, AXIS), rim, _edge(sign)], "world")
        yield line(_edge(sign), end, "world thin dashed")
    yield dot((LENS - NEAR, AXIS), "world", 5)
    yield dot(end, "world", 3.5)
    yield dimension((LENS - NEAR, 212), (LENS, 212), "world")
    yield dimension((LENS, 244), (LENS + tip(), 244), "world")
    yield label((LENS - NEAR / 2, 207), "Z", "world italic", "middle")
    yield label((LENS + tip() / 2, 239), "z", "world italic", "middle")


def _disc_and_opening() -> Iterator[str]:
    """The disc, and the opening that is as wide as the cone's base."""
    place, c = LENS + sensor(), disc()
    corners = ((-2.5, -c / 2), (2.5, -c / 2), (2.5, c / 2), (-2.5, c / 2))
    yield polygon(
        [(LENS, AXIS - HALF), (LENS, AXIS + HALF), (LENS + tip(), AXIS)], "world fill thin"
    )
    yield polygon([(place + x, AXIS + y) for x, y in corners], "error solid")
    yield dimension((LENS - 22, AXIS - HALF), (LENS - 22, AXIS + HALF), "camera")
    yield label((LENS - 30, AXIS - 16), "A", "camera italic ground", "end")
    yield label((place + 10, AXIS - c / 2 - 6), "c", "error italic")


def _edge(sign: int) -> tuple[float, float]:
    """Of the disc."""
    return LENS + sensor(), AXIS + sign * disc() / 2


def draw() -> Illustration:
    words = (
        "A lens is focused at distance s, whose light its sensor gathers in a point. "
        f"The light of a nearer point, at {NEAR / FOCUS:.2f} of that distance, would meet behind "
        f"the sensor, which cuts its cone in a disc of diameter c, {disc() / (2 * HALF):.2f} of "
        "the opening A."
    )
    overlay = in_steps(_focused(), _near(), _disc_and_opening())
    return Illustration((Panel("section", "", 400.0, 268.0, overlay=overlay),), words)
