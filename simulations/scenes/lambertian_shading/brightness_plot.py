"""Brightness of a matte surface against the angle between its normal and the light."""

import math
from collections.abc import Iterator

from simulations.engine.drawing import dot, path, polyline, text
from simulations.engine.frame import format_number

LEFT, RIGHT, TOP, BOTTOM = 58.0, 382.0, 34.0, 282.0
"""The plot's area in the view box."""


def brightness_plot(albedo: float, theta_rad: float, brightness: float) -> str:
    """The curve of Lambert's law, and where on it the probed point is."""
    theta_deg = math.degrees(theta_rad)
    here = on_plot(theta_deg, brightness)
    curve = [on_plot(t, albedo * max(0.0, math.cos(math.radians(t)))) for t in range(0, 181, 2)]
    white = [on_plot(t, max(0.0, math.cos(math.radians(t)))) for t in range(0, 91, 2)]
    label = text(
        (min(here[0] + 16, RIGHT - 62), max(here[1] - 16, TOP + 18)),
        f"I = {format_number(brightness, 3)}",
        "ray strong halo",
    )
    parts = [
        *_axes(),
        polyline(white, "muted thin dashed"),
        polyline(curve, "image bold"),
        path([[(here[0], BOTTOM), here, (LEFT, here[1])]], "ray thin dashed"),
        dot(on_plot(0, albedo), "image", 5.5),
        dot(here, "ray", 5.5),
        label,
    ]
    return "".join(parts)


def _axes() -> Iterator[str]:
    grid = [[on_plot(0, share), on_plot(180, share)] for share in (0.5, 1.0)]
    yield path([*grid, [on_plot(90, 0), on_plot(90, 1)]], "muted thin faint")
    yield path([[on_plot(0, 1), on_plot(0, 0), on_plot(180, 0)]], "muted")
    for degrees in (0, 45, 90, 135, 180):
        x, y = on_plot(degrees, 0)
        yield text((x, y + 19), f"{degrees}°", "muted", "middle")
    for share in (0, 0.5, 1.0):
        x, y = on_plot(0, share)
        yield text((x - 9, y + 4.5), f"{share:g}", "muted", "end")
    yield text((LEFT - 20, TOP - 14), "brightness I", "image")
    yield text((on_plot(59, 0)[0], on_plot(0, 0.56)[1]), "ρ = 1", "muted small halo")
    yield text(
        ((LEFT + RIGHT) / 2, BOTTOM + 42),
        "angle θ between normal and light",
        "",
        "middle",
    )
    yield text((on_plot(135, 0)[0], on_plot(0, 0.2)[1]), "faces away", "muted small", "middle")


def on_plot(theta_deg: float, brightness: float) -> tuple[float, float]:
    return (
        LEFT + (RIGHT - LEFT) * theta_deg / 180,
        BOTTOM - (BOTTOM - TOP) * brightness,
    )


def read_off(place: tuple[float, float]) -> tuple[float, float]:
    """The angle in degrees and the brightness of a place of the plot."""
    return 180 * (place[0] - LEFT) / (RIGHT - LEFT), (BOTTOM - place[1]) / (BOTTOM - TOP)
