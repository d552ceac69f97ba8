"""The lens diagram: cones of light from three distances, and the discs that the sensor cuts.

Distances before the lens are drawn by their square root, the opening by its logarithm, the space
behind the lens not to scale at all. Only the discs on the sensor are to the stated scale: each cone
is drawn through the rim of its disc, with its tip before or behind the sensor.
"""

import math
from collections.abc import Iterator

from simulations.engine.drawing import arrow, dot, ellipse, line, polyline, rectangle, text
from simulations.engine.frame import format_number
from simulations.scenes.depth_of_field.stages import FAR_M, NEAR_M, WIDTH, Sharpness

LENS_X, SENSOR_X, AXIS_Y = 236.0, 336.0, 132.0
LARGEST_DISC = 0.35
"""Largest disc as a share of the drawn opening: wider ones would push a cone's tip out of the
picture."""
LARGEST_M = 10.0
AXIS = line((8, AXIS_Y), (WIDTH - 8, AXIS_Y), "muted thin dashed")
LENS_NAME = text((LENS_X, AXIS_Y - 99), "lens", "camera", "middle")


def column(distance_m: float) -> float:
    """Column of a distance before the lens."""
    return LENS_X - 66.0 * math.sqrt(min(distance_m, LARGEST_M))


def half_opening(aperture_mm: float) -> float:
    """Drawn radius of the opening: 1 mm gives 28 units, 100 mm gives 74."""
    return 28.0 + 23.0 * math.log10(max(aperture_mm, 1.0))


def disc_scale(largest_mm: float, half: float) -> float:
    """Units per millimetre on the sensor, from the series 1, 2, 5, that fit the largest disc.

    A magnification of a thousand is enough: smaller discs are drawn as points.
    """
    largest_scale = min(2 * LARGEST_DISC * half / max(largest_mm, 1e-9), 1000.0)
    power = 10.0 ** math.floor(math.log10(largest_scale))
    return max(step * power for step in (1, 2, 5) if step * power <= largest_scale * (1 + 1e-12))


def lens_diagram(sharp: Sharpness, focus_m: float) -> str:
    """Three cones, the sensor, the band in focus, and the scale of the discs."""
    half = half_opening(sharp.aperture_mm)
    scale = disc_scale(max(sharp.near_blur_mm, sharp.far_blur_mm), half)
    near, far = (column(max(limit, 0.01)) for limit in (sharp.near_limit_m, sharp.far_limit_m))
    far = 8.0 if math.isinf(sharp.far_limit_m) else far
    parts = [AXIS, rectangle((far, AXIS_Y - 9), max(near - far, 0.5), 18, "ray fill thin")]
    wall = (FAR_M, sharp.far_blur_mm, "world")
    ball = (NEAR_M, sharp.near_blur_mm, "error")
    for distance, disc_mm, role in (wall, ball):
        # Light from beyond the focus meets before the sensor, light from nearer behind it.
        sign = -1 if distance > focus_m else 1
        parts += cone(distance, 0.5 * scale * sign * disc_mm, half, role)
    parts += cone(focus_m, 0.0, half, "ray bold")
    parts += [glass(half), line((SENSOR_X, AXIS_Y - 92), (SENSOR_X, AXIS_Y + 92), "image bold")]
    parts += [text((SENSOR_X, AXIS_Y - 99), "sensor", "image", "middle"), LENS_NAME]
    return "".join((*parts, *scale_bar(scale), *labels(focus_m)))


def cone(distance_m: float, disc: float, half: float, role: str) -> Iterator[str]:
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
        top, bottom = AXIS_Y - abs(disc), AXIS_Y + abs(disc)
        beside = SENSOR_X + math.copysign(3, disc)
        yield line((SENSOR_X, top), (SENSOR_X, bottom), "casing")
        yield line((beside, top), (beside, bottom), f"{role} bold")


def glass(half: float) -> str:
    stops = "".join(
        line((LENS_X, AXIS_Y + side * half), (LENS_X, AXIS_Y + side * 92), "camera bold")
        for side in (-1, 1)
    )
    return ellipse((LENS_X, AXIS_Y), (9, half), "camera fill") + stops


def scale_bar(scale: float) -> Iterator[str]:
    """A length of at least 12 units on the sensor, in whole 1-2-5 millimetres."""
    lengths = (step * 10.0**power for power in range(-3, 4) for step in (1, 2, 5))
    mm = next(length for length in lengths if length * scale >= 12)
    x, middle = WIDTH - 24.0, AXIS_Y + 58
    ends = middle - 0.5 * mm * scale, middle + 0.5 * mm * scale
    yield line((x, ends[0]), (x, ends[1]), "bold")
    for y in ends:
        yield line((x - 4, y), (x + 4, y))
    yield text((x - 8, AXIS_Y + 62), f"{mm:g} mm", "ground", "end")


def labels(focus_m: float) -> Iterator[str]:
    """Labels of the three points, above and below the axis."""
    ball, wall = ("red ball", NEAR_M, "error", 104), ("wall", FAR_M, "world", 122)
    for name, distance, role, row in (ball, wall):
        at = column(distance)
        yield line((at, AXIS_Y + 8), (at, AXIS_Y + row - 13), f"{role} thin faint")
        words = f"{name}, {format_number(distance, 1)} m"
        yield text((max(at, 46), AXIS_Y + row), words, f"{role} ground", "middle")
    at = min(max(column(focus_m), 56), LENS_X - 56)
    yield line((column(focus_m), AXIS_Y - 8), (at, AXIS_Y - 72), "ray thin faint")
    words = f"focus {format_number(focus_m, 2)} m"
    yield text((at, AXIS_Y - 78), words, "ray strong ground", "middle")


def virtual_diagram(distance_m: float, focal_m: float) -> str:
    """A point at the focal length or nearer: its light leaves the lens parallel or spreading."""
    half, source, focus = 52.0, (column(distance_m), AXIS_Y), (column(focal_m), AXIS_Y)
    # Deviation as drawn: rays from the drawn focal point come out parallel.
    slope = half / (LENS_X - source[0]) - half / (LENS_X - focus[0])
    reach = min(WIDTH - 8 - LENS_X, (AXIS_Y - half - 10) / max(slope, 1e-6))
    parts = [AXIS]
    for side in (-1, 1):
        rim = (LENS_X, AXIS_Y + side * half)
        end = (LENS_X + reach, rim[1] + side * slope * reach)
        parts += [line(source, rim, "ray"), arrow(rim, end, "ray")]
    parts += [
        glass(half),
        dot(source, "ray", 4),
        dot(focus, "camera", 3),
        text((focus[0] - 6, AXIS_Y - 10), "focal point", "camera ground", "end"),
        LENS_NAME,
        text((12, AXIS_Y + 118), "The light does not meet behind the lens.", "strong"),
    ]
    return "".join(parts)
