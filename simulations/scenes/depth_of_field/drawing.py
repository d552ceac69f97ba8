"""The lens diagram: cones of light from three distances, and the discs that the sensor cuts.

Distances before the lens are drawn by their square root, the opening by its logarithm, the space
behind the lens not to scale at all. Only the discs on the sensor are to the stated scale: each cone
is drawn through the rim of its disc, with its tip before or behind the sensor.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from simulations.engine.drawing import Point, arrow, dot, ellipse, line, polyline, rectangle, text
from simulations.engine.frame import format_number

WIDTH, HEIGHT = 420.0, 280.0
LENS_X, SENSOR_X, AXIS_Y = 236.0, 336.0, 132.0
LARGEST_DISC = 0.35
"""Largest disc as a share of the drawn opening: wider ones would push a cone's tip out of the
picture."""
LARGEST_M = 10.0


@dataclass(frozen=True, slots=True)
class Blurred:
    """A point out of focus."""

    name: str
    distance_m: float
    disc_mm: float


@dataclass(frozen=True, slots=True)
class Lens:
    """The quantities in the diagram."""

    aperture_mm: float
    focus_m: float
    near: Blurred
    far: Blurred
    sharp_m: tuple[float, float]
    """Depth of field; its far end may be infinite."""


def column(distance_m: float) -> float:
    """Column of a distance before the lens."""
    return LENS_X - 66.0 * math.sqrt(min(distance_m, LARGEST_M))


def distance_of(column: float) -> float:
    """The distance before the lens at a column; 0 beyond the lens."""
    return (max(LENS_X - column, 0.0) / 66.0) ** 2


def half_opening(aperture_mm: float) -> float:
    """Drawn radius of the opening: 1 mm gives 28 units, 100 mm gives 74."""
    return 28.0 + 23.0 * math.log10(max(aperture_mm, 1.0))


def aperture_of(half: float) -> float:
    """The opening in mm whose drawn radius is ``half``."""
    return math.pow(10.0, (min(max(half, 28.0), HEIGHT) - 28.0) / 23.0)


def disc_scale(largest_mm: float, half: float) -> float:
    """Units per millimetre on the sensor, from the series 1, 2, 5, that fit the largest disc.

    A magnification of a thousand is enough: smaller discs are drawn as points.
    """
    wanted = min(2 * LARGEST_DISC * half / max(largest_mm, 1e-9), 1000.0)
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(step * power for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-12))


def lens_diagram(lens: Lens) -> str:
    """Three cones, the sensor, the band in focus, and the scale of the discs."""
    half = half_opening(lens.aperture_mm)
    scale = disc_scale(max(lens.near.disc_mm, lens.far.disc_mm), half)
    behind_focus = lens.near.distance_m > lens.focus_m
    before_focus = lens.far.distance_m < lens.focus_m
    # Light from beyond the focus meets before the sensor, light from nearer behind it.
    discs = (
        (lens.far, -lens.far.disc_mm if not before_focus else lens.far.disc_mm, "world"),
        (lens.near, lens.near.disc_mm if not behind_focus else -lens.near.disc_mm, "error"),
    )
    parts = [*_axis(), *_in_focus(lens)]
    for point, signed_mm, role in discs:
        parts += _cone(point.distance_m, 0.5 * scale * signed_mm, half, role)
    parts += _cone(lens.focus_m, 0.0, half, "ray bold")
    parts += [_glass(half), *_sensor(), *_scale_bar(scale)]
    parts += _labels(lens)
    return "".join(parts)


def _axis() -> Iterator[str]:
    yield line((8, AXIS_Y), (WIDTH - 8, AXIS_Y), "muted thin dashed")


def _in_focus(lens: Lens) -> Iterator[str]:
    """The depth of field as a band along the axis."""
    near, far = (column(max(distance, 0.01)) for distance in lens.sharp_m)
    far = 8.0 if math.isinf(lens.sharp_m[1]) else far
    yield rectangle((far, AXIS_Y - 9), max(near - far, 0.5), 18, "ray fill thin")


def _cone(distance_m: float, disc: float, half: float, role: str) -> Iterator[str]:
    """Rim rays from the point through the lens; ``disc`` is the signed radius on the sensor.

    Positive: the sensor is met before the tip. Negative: the rays have crossed already.
    """
    source = (column(distance_m), AXIS_Y)
    depth = SENSOR_X - LENS_X
    tip = (LENS_X + depth * half / (half - disc), AXIS_Y)
    for side in (-1, 1):
        rim = (LENS_X, AXIS_Y + side * half)
        ends = [source, rim, (SENSOR_X, AXIS_Y + side * disc)]
        if tip[0] > SENSOR_X:  # where the rays would have met
            yield line(ends[-1], tip, f"{role} thin dashed")
        yield polyline(ends, role)
    yield dot(source, role.partition(" ")[0], 4)
    if abs(disc) > 0.5:
        yield line((SENSOR_X, AXIS_Y - abs(disc)), (SENSOR_X, AXIS_Y + abs(disc)), "casing")
        offset = 3 if disc > 0 else -3
        yield line(
            (SENSOR_X + offset, AXIS_Y - abs(disc)),
            (SENSOR_X + offset, AXIS_Y + abs(disc)),
            f"{role} bold",
        )


def _glass(half: float) -> str:
    rims = ((LENS_X, AXIS_Y - half), (LENS_X, AXIS_Y + half))
    stops = "".join(
        line(rim, (LENS_X, AXIS_Y + side * 92), "camera bold")
        for side, rim in zip((-1, 1), rims, strict=True)
    )
    return ellipse((LENS_X, AXIS_Y), (9, half), "camera fill") + stops


def _sensor() -> Iterator[str]:
    yield line((SENSOR_X, AXIS_Y - 92), (SENSOR_X, AXIS_Y + 92), "image bold")
    yield text((SENSOR_X, AXIS_Y - 99), "sensor", "image", "middle")
    yield text((LENS_X, AXIS_Y - 99), "lens", "camera", "middle")


def _scale_bar(scale: float) -> Iterator[str]:
    """A length of at least 12 units on the sensor, in whole 1-2-5 millimetres."""
    mm = next(
        step * 10.0**power
        for power in range(-3, 4)
        for step in (1, 2, 5)
        if step * 10.0**power * scale >= 12
    )
    x = WIDTH - 24.0
    top, bottom = AXIS_Y - 0.5 * mm * scale, AXIS_Y + 0.5 * mm * scale
    top, bottom = top + 58, bottom + 58
    yield line((x, top), (x, bottom), "bold")
    for y in (top, bottom):
        yield line((x - 4, y), (x + 4, y))
    yield text((x - 8, AXIS_Y + 62), f"{mm:g} mm", "ground", "end")


def _labels(lens: Lens) -> Iterator[str]:
    """Labels of the three points, above and below the axis."""
    for point, role, row in ((lens.near, "error", 104), (lens.far, "world", 122)):
        at = column(point.distance_m)
        yield line((at, AXIS_Y + 8), (at, AXIS_Y + row - 13), f"{role} thin faint")
        name = f"{point.name}, {format_number(point.distance_m, 1)} m"
        yield text((max(at, 46), AXIS_Y + row), name, f"{role} ground", "middle")
    at = min(max(column(lens.focus_m), 56), LENS_X - 56)
    yield line((column(lens.focus_m), AXIS_Y - 8), (at, AXIS_Y - 72), "ray thin faint")
    name = f"focus {format_number(lens.focus_m, 2)} m"
    yield text((at, AXIS_Y - 78), name, "ray strong ground", "middle")


def virtual_diagram(distance_m: float, focal_m: float) -> str:
    """A point at the focal length or nearer: its light leaves the lens parallel or spreading."""
    half, source = 52.0, (column(distance_m), AXIS_Y)
    focus = (column(focal_m), AXIS_Y)
    # Deviation as drawn: rays from the drawn focal point come out parallel.
    slope = half / (LENS_X - source[0]) - half / (LENS_X - focus[0])
    parts = [*_axis()]
    for side in (-1, 1):
        rim = (LENS_X, AXIS_Y + side * half)
        reach = min(WIDTH - 8 - LENS_X, (AXIS_Y - half - 10) / max(slope, 1e-6))
        end: Point = (LENS_X + reach, rim[1] + side * slope * reach)
        parts += [line(source, rim, "ray"), arrow(rim, end, "ray")]
    parts += [
        _glass(half),
        dot(source, "ray", 4),
        dot(focus, "camera", 3),
        text((focus[0] - 6, AXIS_Y - 10), "focal point", "camera ground", "end"),
        text((LENS_X, AXIS_Y - 99), "lens", "camera", "middle"),
        text((12, AXIS_Y + 118), "The light does not meet behind the lens.", "strong"),
    ]
    return "".join(parts)
