"""The radial profile of the lens-distortion figure: image radius against ideal radius."""

import math

import numpy as np

from simulations.engine.drawing import Point, dot, line, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.distortion.lens_model import (
    Distortion,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import SAMPLE

LARGEST = 1.25
"""Radius at the ends of the axes."""
PLOT = Plot(Axis(0.0, LARGEST, 44.0, 386.0), Axis(0.0, LARGEST, 250.0, 16.0))
IDEAL, SEEN = Scale(ticks=(0, 0.5, 1), grid=(1,)), Scale(ticks=(0, 0.5, 1), grid=(1,))


def profile_overlay(lens: Distortion) -> str:
    """Image radius against ideal radius: the curve that the coefficients describe."""
    fold = fold_radius(lens)
    before = np.linspace(0.0, min(fold, LARGEST), 101)
    parts = [
        _axes(),
        line(at_radii(0, 0), at_radii(LARGEST, LARGEST), "muted thin dashed"),
        text(_identity_label(lens), "no distortion", "muted small ground", "end"),
        PLOT.curve(before, evaluate(lens.radial, before), "image bold"),
    ]
    if fold < LARGEST:
        after = np.linspace(fold, LARGEST, 51)
        peak = at_radii(fold, largest_distorted_radius(lens))
        parts += [
            PLOT.curve(after, evaluate(lens.radial, after), "error dashed"),
            line(peak, (peak[0], PLOT.y.start), "error thin dashed"),
            dot(peak, "error"),
            text((peak[0], peak[1] - 10.0), "fold", "error small ground", "middle"),
        ]
    ideal = math.hypot(*SAMPLE)
    here = at_radii(ideal, float(evaluate(lens.radial, ideal)))
    parts += [
        line((here[0], PLOT.y.start), here, "world thin"),
        line((PLOT.x.start, here[1]), here, "image thin"),
        dot(here, "image"),
    ]
    return "".join(parts)


def at_radii(radius: float, image: float) -> tuple[float, float]:
    """A point of the profile as view box units."""
    return PLOT.at(float(radius), float(image))


def _identity_label(lens: Distortion) -> Point:
    """Label next to the dashed line, on the side away from the curve."""
    inwards = float(evaluate(lens.radial, 1.0)) < 0.99
    return at_radii(1.12, 1.19) if inwards else at_radii(LARGEST, 0.86)


def _axes() -> str:
    x, foot = at_radii(1.0, 0.0)
    return "".join(
        (
            PLOT.frame(IDEAL, SEEN),
            text((x - 5, foot - 14), "corner", "muted small ground", "end"),
            text((0.5 * (PLOT.x.start + PLOT.x.end), foot + 41), "ideal radius", "world", "middle"),
            text((PLOT.x.start + 8, PLOT.y.end + 8), "radius in the image", "image ground"),
        )
    )
