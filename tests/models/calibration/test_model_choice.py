"""Which lens the photographs support, what they cover, and what to photograph next."""

import numpy as np
import pytest
from support.sittings import SIZE, photographs

from simulations.models.calibration.advice import Coverage, coverage, emptiest, next_photograph
from simulations.models.calibration.bundle_adjustment import calibrate
from simulations.models.calibration.camera import LENSES, Camera
from simulations.models.calibration.model_choice import (
    akaike,
    compare,
    compare_first,
    supported,
)
from simulations.models.distortion.lens_model import Distortion


@pytest.mark.parametrize(
    ("lens", "expected"),
    [
        (Distortion(), "none"),
        (Distortion(k1=-0.1), "k1"),
        (Distortion(k1=-0.3, k2=0.15), "k1k2"),
        (Distortion(k1=-0.3, k2=0.15, p1=2e-3, p2=-2e-3), "p1p2"),
        (Distortion(k1=-0.3, k2=0.15, p1=2e-3, p2=-2e-3, k3=0.5), "k3"),
    ],
)
def test_the_model_that_made_the_photographs_is_supported(lens: Distortion, expected: str) -> None:
    truth = photographs(12, seed=7, camera=Camera(500.0, 500.0, 322.0, 236.0, lens))
    views = truth.views(0.05)
    trials = compare(views, SIZE)
    assert supported(trials).lens == expected
    assert min(trials, key=lambda trial: trial.aic).rms_px == pytest.approx(
        supported(trials).rms_px, rel=0.01
    )


def test_a_richer_model_fits_better_and_predicts_worse() -> None:
    truth = photographs(4, seed=1, camera=Camera(500.0, 500.0, 322.0, 236.0))
    views = truth.views(0.5)
    trials = compare(views, SIZE)
    assert [trial.lens for trial in trials] == list(LENSES)
    assert trials[-1].rms_px < trials[0].rms_px
    assert trials[-1].left_out_px > trials[0].left_out_px


def test_the_first_photographs_are_judged_alike_from_either_start() -> None:
    views = photographs(10, seed=2).views(0.1)
    first = views.take(slice(6))
    cold, warm = compare(first, SIZE), compare_first(compare(views, SIZE), first)
    for one, other in zip(cold, warm, strict=True):
        assert one.lens == other.lens
        assert one.left_out_px == pytest.approx(other.left_out_px)
        assert one.aic == pytest.approx(other.aic)


@pytest.mark.parametrize("count", [3, 6, 9])
def test_a_draft_of_few_steps_has_the_same_models_and_supports_the_same(count: int) -> None:
    views = photographs(10, seed=2).views(0.1)
    first, every = views.take(slice(count)), compare(views, SIZE)
    whole, draft = compare_first(every, first), compare_first(every, first, draft=True)
    assert [trial.lens for trial in draft] == [trial.lens for trial in whole]
    assert supported(draft).lens == supported(whole).lens
    for one, other in zip(draft, whole, strict=True):
        assert abs(one.fit.camera.fx - other.fit.camera.fx) < other.uncertainty.errors["fx"]


def test_akaike_charges_two_for_each_parameter() -> None:
    assert akaike(100, 25.0, 7) - akaike(100, 25.0, 5) == pytest.approx(4.0)
    assert akaike(100, 50.0, 5) - akaike(100, 25.0, 5) == pytest.approx(100 * np.log(2))


def test_coverage_counts_corners_and_measures_tilt_and_distance() -> None:
    truth = photographs(5)
    views = truth.views(0.0)
    covered = coverage(views, calibrate(views, SIZE), SIZE)
    assert covered.cells.sum() == views.corners
    assert covered.cells.shape == (6, 8)
    assert covered.tilt_rad == pytest.approx(np.arccos(truth.poses.R[:, 2, 2]), abs=1e-6)
    assert np.all((covered.distance > 5.0) & (covered.distance < 40.0))


def covered(
    tilt_deg: float = 30.0,
    count: int = 12,
    nearest: float = 10.0,
    empty: tuple[slice, slice] | None = None,
) -> Coverage:
    cells = np.ones((6, 8))
    if empty:
        cells[empty] = 0.0
    distance = np.linspace(nearest, 20.0, count)
    return Coverage(cells, np.full(count, np.radians(tilt_deg)), distance)


def test_next_photograph_is_what_is_missing_most() -> None:
    right = (slice(0, 6), slice(5, 8))
    assert next_photograph(covered(tilt_deg=5.0, empty=right)) == "tilted by 30° to 45°"
    assert next_photograph(covered(empty=right)).endswith("right")
    assert next_photograph(covered(empty=(slice(1, 5), slice(2, 6)))) == "in the middle"
    assert next_photograph(covered(count=5)) == "from another side"
    assert next_photograph(covered(nearest=18.0)) == "nearer or farther"
    assert next_photograph(covered()) == "nothing is missing"


def test_the_emptiest_part_is_named() -> None:
    assert emptiest(covered(empty=(slice(4, 6), slice(0, 3)))) == "bottom left"
    assert emptiest(covered(empty=(slice(2, 4), slice(3, 5)))) == "middle"
