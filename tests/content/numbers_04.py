"""Chapter 4: the distortion of lenses."""

from math import inf, isclose

import numpy as np
from support.worked_numbers import Says

from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    jacobian,
)
from simulations.models.lens.singlet import (
    Singlet,
    paraxial_image_mm,
    through_exact,
    through_paraxial,
)
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.scenes.lens_distortion.radii import inversion_error_px

CHAPTER = "04-lens-distortion"
BARREL, PINCUSHION = Distortion(k1=-0.2), Distortion(k1=0.2)


def which_way_round() -> Says:
    """How much of the turn falls to the front, by small angles and by Snell's law."""
    for front, share in ((1 / 25, 2 / 3), (0.0, 0.0)):
        turn = -through_paraxial(Singlet(front, front - 1 / 25, 1e-6, 1.5), inf, [1.0]).slope[0]
        assert isclose((1 - 1 / 1.5) * front / turn, share, abs_tol=1e-9)
    yield "the first twice as much as the second"
    forwards, backwards = (
        paraxial_image_mm(lens, inf) - float(through_exact(lens, inf, [10.0], 22.0).crossing_mm[0])
        for lens in (Singlet(1 / 25, 0.0, 6.0, 1.5), Singlet(0.0, -1 / 25, 6.0, 1.5))
    )
    assert 3.7 < backwards / forwards < 4.3
    yield ": four times as much. A sine is smaller"


def five_steps_of_newton_near_a_fold() -> Says:
    fixed_point, newton = (
        inversion_error_px(BARREL, tier) for tier in ("fixed-point-5", "newton-5")
    )
    assert 300 < fixed_point / newton < 400
    yield "Five steps of Newton are three hundred times as good"
    nearly = Distortion(k1=-0.45, k2=0.1)
    assert fold_radius(nearly) == np.inf
    slope = min(jacobian([[r, 0.0] for r in np.linspace(0, 2, 2001)], nearly)[:, 0, 0])
    assert 0 < slope < 0.1, "the slope comes close to zero"
    off_px = inversion_error_px(nearly, "newton-5")
    yield f"five steps of Newton are off by {off_px:.0f} px in the RMS"


def cos4_at_45_degrees() -> Says:
    assert np.isclose(vignetting_cos4(1.0), 1 / 4), "two stops"
    yield "its fourth power ¼, so the corners lose two stops"


def cubic_growth() -> Says:
    near, far = (distort([r, 0], PINCUSHION)[0] - r for r in (0.2, 0.6))
    assert np.isclose(2 * far / near, 54)
    yield "a point at $r = 0.2$ is moved by 2 px. At which radius is a point moved by 54 px?"
    yield "- [x] `0.2 * 27 ** (1 / 3)`"


def lines_between_coefficients_that_cancel() -> Says:
    """Level lines turn back on their way outwards, the upright ones at the border do not."""
    lens, along = Distortion(k1=-0.2, k2=0.2), np.linspace(0, 0.8, 41)
    for height in (0.2, 0.4, 0.6):
        level = distort(np.stack([along, np.full_like(along, height)], -1), lens)[:, 1]
        assert 0 < np.argmin(level) < 40
    side = distort(np.stack([np.full_like(along, 0.8), along], -1), lens)[:31, 0]
    assert (np.diff(side) > 0).all()
    yield "Level lines bend one way in their middle and back at their ends."
    yield "The upright lines at the border bow inwards."


WORKED = (
    which_way_round,
    five_steps_of_newton_near_a_fold,
    cos4_at_45_degrees,
    cubic_growth,
    lines_between_coefficients_that_cancel,
)
