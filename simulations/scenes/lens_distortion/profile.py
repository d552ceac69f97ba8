"""The radial profile of the lens-distortion figure: image radius against ideal radius."""

import math

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, polyline, text
from simulations.models.distortion.lens_model import (
    Distortion,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import SAMPLE, VIEW_HEIGHT, runs

LEFT, RIGHT, TOP, BOTTOM = 44.0, 386.0, 16.0, 258.0
LARGEST = 1.25
"""Radius at the ends of the axes."""


def profile_overlay(lens: Distortion) -> str:
    """Image radius against ideal radius: the curve that the coefficients describe."""
    fold = fold_radius(lens)
    radius = np.linspace(0.0, LARGEST, 101)
    if fold < LARGEST:
        radius = np.sort(np.append(radius, fold))
    image = evaluate(lens.radial, radius)
    curve = np.stack([at_radii(r, f) for r, f in zip(radius, image, strict=True)])
    visible = (image <= LARGEST) & (image >= 0.0)
    parts = [
        _axes(),
        polyline((at_radii(0, 0), at_radii(LARGEST, LARGEST)), "muted thin dashed"),
        text(_identity_label(lens), "no distortion", "muted small halo", "end"),
        path(runs(curve, (radius >= fold) & visible), "error dashed") if fold < LARGEST else "",
        path(runs(curve, (radius <= fold) & visible), "image bold"),
    ]
    if fold < LARGEST:
        peak = at_radii(fold, largest_distorted_radius(lens))
        parts += [
            line(peak, (peak[0], BOTTOM), "error thin dashed"),
            dot(peak, "error"),
            text((peak[0], peak[1] - 10.0), "fold", "error small halo", "middle"),
        ]
    ideal = math.hypot(*SAMPLE)
    here = at_radii(ideal, float(evaluate(lens.radial, ideal)))
    parts += [
        line((here[0], BOTTOM), here, "world thin"),
        line((LEFT, here[1]), here, "image thin"),
        dot(here, "image"),
    ]
    return "".join(parts)


def at_radii(radius: float, image: float) -> tuple[float, float]:
    """A point of the profile as view box units."""
    across = (RIGHT - LEFT) / LARGEST
    up = (BOTTOM - TOP) / LARGEST
    return (LEFT + across * float(radius), BOTTOM - up * float(image))


def radius_at(place: Point) -> tuple[float, float]:
    """Ideal radius and radius in the image of a place of the panel."""
    across = (RIGHT - LEFT) / LARGEST
    up = (BOTTOM - TOP) / LARGEST
    return ((float(place[0]) - LEFT) / across, (BOTTOM - float(place[1])) / up)


def _identity_label(lens: Distortion) -> Point:
    """Beside the dashed line, on the side where the curve is not."""
    inwards = float(evaluate(lens.radial, 1.0)) < 0.99
    return at_radii(1.12, 1.19) if inwards else at_radii(LARGEST, 0.86)


def _axes() -> str:
    corner_x, corner_y = at_radii(1.0, 0.0)[0], at_radii(0.0, 1.0)[1]
    parts = [
        line((LEFT, BOTTOM), (RIGHT, BOTTOM), "muted"),
        line((LEFT, BOTTOM), (LEFT, TOP), "muted"),
        line((corner_x, BOTTOM), (corner_x, TOP), "muted thin faint"),
        line((LEFT, corner_y), (RIGHT, corner_y), "muted thin faint"),
        text((corner_x - 5, TOP + 212), "corner", "muted small halo", "end"),
        text((0.5 * (LEFT + RIGHT), VIEW_HEIGHT - 8), "ideal radius", "world", "middle"),
        text((LEFT + 8, TOP + 8), "radius in the image", "image halo"),
    ]
    for value in (0.0, 0.5, 1.0):
        x, y = at_radii(value, 0.0)[0], at_radii(0.0, value)[1]
        parts.append(text((x, BOTTOM + 16), f"{value:g}", "muted small", "middle"))
        parts.append(text((LEFT - 8, y + 4), f"{value:g}", "muted small", "end"))
    return "".join(parts)
