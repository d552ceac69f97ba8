"""From the closed form all searches arrive; from a poor guess only the damped one does."""

import numpy as np
import pytest
from support.ladder_run import LadderRun

from simulations.ladders.camera_calibration import LADDER, NOISE_PX, TRUTH, arrived, rms_px

RUN = LadderRun(LADDER)


def test_the_reference_is_the_truth_as_far_as_noise_allows() -> None:
    off = RUN.truth - RUN.work.views.pixels
    spare = 1.0 - (6 * len(off) + 6) / off.size
    assert np.sqrt((off * off).mean() / spare) == pytest.approx(NOISE_PX, rel=0.05)


def test_each_step_leaves_a_small_part_of_the_error_of_the_closed_form() -> None:
    errors = RUN.measured(rms_px)
    assert errors["closed-form"] > 5.0 * errors["gauss-newton-1"]
    assert errors["gauss-newton-1"] > 100.0 * errors["gauss-newton-3"]
    assert max(errors["gauss-newton"], errors["levenberg-marquardt"]) < 1e-6


def test_the_damped_search_arrives_from_every_guess_and_the_plain_one_does_not() -> None:
    shares = RUN.measured(arrived)
    assert shares["levenberg-marquardt"] == 100.0
    assert 50.0 < shares["gauss-newton"] < 100.0
    assert shares["closed-form"] == 0.0


def test_poor_guesses_are_poor() -> None:
    focal = [camera.fx / TRUTH.fx for camera, _ in RUN.work.poor]
    assert min(abs(np.log(focal))) > 0.3
