"""The step wedge against the theory of noise; the shot-noise models against Poisson's law."""

import itertools
import math
from functools import partial

import numpy as np
import pytest
from scipy import stats
from support.frames import estimates_of, outputs_of

from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb
from simulations.models.sensor.photon_counting import SHOT_MODELS
from simulations.models.sensor.poisson import gap_from_poisson, largest_chance_gap
from simulations.scenes.sensor_noise.scene import SCENE
from simulations.scenes.sensor_noise.sensor import (
    EXPOSURES,
    FULL_WELL_E,
    Transfer,
    patch_means_e,
    sensor_of,
)

outputs, estimates = partial(outputs_of, SCENE), partial(estimates_of, SCENE)
SCATTER = 4 * math.sqrt(2 / 1600)  # four standard deviations of a variance of 1600 samples


def transfer(**given: object) -> Transfer:
    measured: Transfer = outputs("poisson", **given)["transfer"]
    return measured


@pytest.mark.parametrize("unequal", [1, 5])
def test_two_frames_measure_the_gain_of_unequal_cells(unequal: float) -> None:
    even, measured = transfer(), transfer(unequal=unequal)
    assert measured.gain is not None
    assert measured.gain.e_per_dn == pytest.approx(sensor_of(12, 100, 10).gain_e_per_dn, rel=0.06)
    inside = measured.fitted & even.fitted
    one, two, mean = (
        part[inside] for part in (measured.one_frame_dn2, measured.variance_dn, measured.mean_dn)
    )
    pattern = (unequal / 100 * mean) ** 2
    np.testing.assert_allclose(one - two, pattern, rtol=0.1, atol=SCATTER * one.max())


@pytest.mark.parametrize("dark", [0, 2000])
def test_variance_is_the_sum_of_shot_read_dark_and_rounding_noise(dark: float) -> None:
    measured = transfer(bits=14, read_noise=20, dark=dark)
    gain = sensor_of(14, 100, 20).gain_e_per_dn
    expected = (patch_means_e(0) + dark + 20**2) / gain**2 + 1 / 12
    inside = patch_means_e(0) + dark < 0.9 * FULL_WELL_E
    assert np.count_nonzero(inside) > 18
    for variance in (measured.one_frame_dn2, measured.variance_dn):
        assert variance[inside] == pytest.approx(expected[inside], rel=SCATTER)
    means = patch_means_e(0)[inside] / gain
    assert measured.mean_dn[inside] == pytest.approx(means, rel=0.02, abs=5 / gain)
    assert not measured.fitted[~inside & (patch_means_e(0) + dark > FULL_WELL_E)].any()


@pytest.mark.parametrize("iso", ["100", "6400"])
@pytest.mark.parametrize("bits", [4, 8, 12, 14])
def test_gain_agrees_with_truth_within_its_errors(iso: str, bits: int) -> None:
    """Coarse codes, hot sensors and full wells give the right gain or none."""
    for exposure, dark, read_noise in itertools.product((0, -3, -6), (0, 2000), (0, 10, 60)):
        given = {"iso": iso, "bits": bits, "exposure": exposure}
        gain = transfer(**given, dark=dark, read_noise=read_noise).gain
        if gain is None:
            continue
        off = gain.e_per_dn - sensor_of(bits, float(iso), read_noise).gain_e_per_dn
        assert abs(off) < 3.5 * gain.error_e_per_dn, (given, dark, read_noise)
        assert gain.error_e_per_dn < 0.1 * gain.e_per_dn


def detailed() -> Photograph:
    """A picture with detail in every patch: a slanted ramp over fine stripes."""
    y, x = np.mgrid[:160, :240]
    levels = np.clip(20 + 0.4 * x + 0.3 * y + 25 * (x % 4 < 2), 0, 255).astype(np.uint8)
    return Photograph(1, np.stack([levels, levels, levels], axis=-1))


@pytest.mark.parametrize(("iso", "exposure"), [("100", 0), ("1600", -4)])
def test_detail_of_a_readers_picture_leaves_the_gain_unchanged(iso: str, exposure: float) -> None:
    settings, cache = SCENE.check({"iso": iso, "exposure": exposure}), StageCache()
    done = SCENE.run(settings, "quantile", cache, detailed()).outputs
    tile = decode_srgb(detailed().codes[40:80, 80:120, 0] / 255).ravel()
    assert done["light"][8] == pytest.approx(FULL_WELL_E * 2.0**exposure * tile, rel=1e-3)
    gain = done["transfer"].gain
    assert gain is not None
    assert gain.e_per_dn == pytest.approx(sensor_of(12, float(iso), 10).gain_e_per_dn, rel=0.15)
    shown = SCENE.render(settings, "quantile", cache, detailed())
    assert shown.description.startswith(f"Your own picture at ISO {iso}")
    assert {place.name for place in shown.handles} == {"patch"}
    *_, last = SCENE.estimates(settings, "quantile", StageCache(), detailed())
    assert float(last.text) < 1.6 * largest_chance_gap(24, 1600 * EXPOSURES)


def rounded_normal(mean: float, counts: Floats) -> Floats:
    """P(N ≤ k) of a normal that is rounded and not negative."""
    share: Floats = stats.norm.cdf((counts + 0.5 - mean) / np.sqrt(mean))
    return share


@pytest.mark.parametrize("exposure", [0, -3, -6])
def test_gap_to_poisson_agrees_with_the_two_laws(exposure: float) -> None:
    """At the dim end the gap is known by formula; samples of 16 exposures scatter about it."""
    counts, chance = np.arange(200.0), largest_chance_gap(24, 1600 * EXPOSURES)
    gap = max(
        np.abs(rounded_normal(mean, counts) - stats.poisson.cdf(counts, mean)).max()
        for mean in patch_means_e(exposure)[-10:]
    )
    found = {tier: float(estimates(tier, exposure=exposure)[-1].text) for tier in SHOT_MODELS}
    assert found["gaussian"] == pytest.approx(gap, abs=chance)
    assert max(found["quantile"], found["poisson"]) < 1.6 * chance
    if exposure == -3:
        assert found["skewed"] < found["gaussian"] / 3


@pytest.mark.parametrize("tier", SHOT_MODELS)
def test_first_estimate_is_of_the_shown_electrons(tier: str) -> None:
    shown = outputs(tier, exposure=-4, dark=40)["electrons"][0]
    pairs = zip(shown, patch_means_e(-4) + 40, strict=True)
    gap = max(gap_from_poisson(counted, mean, FULL_WELL_E) for counted, mean in pairs)
    first, *more = estimates(tier, exposure=-4, dark=40)
    assert first.text == f"{gap:.3f}"
    assert len(more) == EXPOSURES - 1


def test_automatic_iso_keeps_the_room_as_bright_and_makes_it_noisier() -> None:
    """As a second take shows, whose room is the same and whose noise is not."""
    noises, levels = [], []
    for exposure in (0, -3, -6):
        takes = [
            decode_srgb(outputs(iso="auto", exposure=exposure, new_noise=take)["room"] / 255)[
                ..., :3
            ]
            for take in (0, 1)
        ]
        noises.append((takes[0] - takes[1]).std())
        levels.append(takes[0].mean())
    assert levels == pytest.approx([levels[0]] * 3, rel=0.03)
    assert noises[2] > 2 * noises[1] > 4 * noises[0]
