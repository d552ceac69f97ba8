"""Chapter 4: the distortion of lenses."""

import numpy as np
from support.worked_numbers import Says

from simulations.models.distortion.lens_model import (
    Distortion,
    fold_radius,
    jacobian,
)
from simulations.scenes.lens_distortion.stages import inversion_error_px

CHAPTER = "04-lens-distortion"
BARREL, PINCUSHION = Distortion(k1=-0.2), Distortion(k1=0.2)


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
