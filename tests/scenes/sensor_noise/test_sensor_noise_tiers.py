"""Models of shot noise side by side: how far each is from Poisson's law, and which is dragged."""

import math
from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats
from support.frames import estimates_of, frame_of, outputs_of, texts_at

from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import SHOT_MODELS
from simulations.models.sensor.poisson import gap_from_poisson, largest_chance_gap
from simulations.scenes.sensor_noise.error import EXPOSURES
from simulations.scenes.sensor_noise.scene import SCENE
from simulations.scenes.sensor_noise.stages import (
    FULL_WELL_E,
    patch_means_e,
    sensor_of,
)

frame = partial(frame_of, SCENE)


texts = partial(texts_at, SCENE)


outputs = partial(outputs_of, SCENE)


estimates = partial(estimates_of, SCENE)


def rounded_normal(mean: float, counts: NDArray[np.integer]) -> Floats:
    """P(N ≤ k) of a normal that is rounded and held at 0."""
    share: Floats = stats.norm.cdf((counts + 0.5 - mean) / np.sqrt(mean))
    return share


def test_more_light_adds_to_the_grain_that_is_there_and_does_not_reshuffle_it() -> None:
    """Half a stop: a new draw of the electrons would leave no correlation."""
    shown = {
        tier: [outputs(tier, exposure=ev)["electrons"][0, 20] for ev in (-2, -1.5)]
        for tier in ("quantile", "poisson")
    }
    kept, drawn_anew = (np.corrcoef(*pair)[0, 1] for pair in shown.values())
    assert kept > 0.99
    assert abs(drawn_anew) < 0.5


@pytest.mark.parametrize("tier", ["quantile", "poisson"])
@pytest.mark.parametrize("exposure", [0, -3, -6])
def test_exact_electrons_are_as_far_from_poissons_law_as_chance_would_have_it(
    exposure: float, tier: str
) -> None:
    told = float(estimates(tier, exposure=exposure)[-1].text)
    assert told < 1.6 * largest_chance_gap(24, 1600 * EXPOSURES)


@pytest.mark.parametrize("exposure", [0, -3, -6])
def test_the_error_of_rounded_normals_is_the_gap_of_the_two_laws(exposure: float) -> None:
    """At the dim end the gap is known by formula; samples of 16 exposures scatter about it."""
    counts = np.arange(200)
    gap = max(
        np.abs(rounded_normal(mean, counts) - stats.poisson.cdf(counts, mean)).max()
        for mean in patch_means_e(exposure)[-10:]
    )
    told = float(estimates("gaussian", exposure=exposure)[-1].text)
    assert told == pytest.approx(gap, abs=largest_chance_gap(24, 1600 * EXPOSURES))


def test_the_lean_to_the_right_takes_most_of_the_error_away() -> None:
    plain, leaning = (float(estimates(t, exposure=-3)[-1].text) for t in ("gaussian", "skewed"))
    assert leaning < plain / 3


def test_the_first_estimate_is_of_the_very_electrons_that_are_shown() -> None:
    given = {"exposure": -4, "dark": 40}
    for tier in SHOT_MODELS:
        shown = outputs(tier, **given)["electrons"][0]
        gap = max(
            gap_from_poisson(counted, mean, FULL_WELL_E)
            for counted, mean in zip(shown, patch_means_e(-4) + 40, strict=True)
        )
        first, *more = estimates(tier, **given)
        assert first.text == f"{gap:.3f}"
        assert f"1 of {EXPOSURES} exposures" in first.label
        assert len(more) == EXPOSURES - 1


def test_a_rounded_normal_is_too_bright_where_it_may_not_be_negative() -> None:
    """The chapter's setting: 0.22 electrons in the darkest patch, and nothing but shot noise."""
    given = {"exposure": -6, "iso": "6400", "bits": 14, "read_noise": 0, "patch": 24}
    mean = patch_means_e(-6)[-1]
    held = np.sum(1 - rounded_normal(mean, np.arange(50)))
    assert held > 1.25 * mean
    gain = sensor_of(14, "6400", 0).gain_e_per_dn
    for tier, expected in (("gaussian", held), ("quantile", mean), ("poisson", mean)):
        shown = texts(tier, **given)
        scatter = 4 * math.sqrt(mean / 3200)
        assert float(shown["mean"]) * gain == pytest.approx(expected, abs=scatter)
