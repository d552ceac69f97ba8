"""The aliasing figure: what it reads out, and its picture, which is the sampled pattern."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, pixels_of, texts_of

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb
from simulations.scenes.aliasing.pattern import pattern_of
from simulations.scenes.aliasing.scene import SCENE

frame = partial(frame_of, SCENE)


def light(shown: Frame) -> Floats:
    return decode_srgb(pixels_of(shown)[..., 0] / 255.0)


def test_the_shirt_of_the_chapter_gets_a_false_stripe_every_five_pixels() -> None:
    shown = frame(frequency=0.8)
    row = light(shown)[0]
    np.testing.assert_allclose(row[5:], row[:-5], atol=0.01)
    np.testing.assert_allclose(row, light(frame(frequency=0.2))[0], atol=0.01)


@pytest.mark.parametrize(("phase", "kept"), [(0, "0.000"), (30, "0.500"), (90, "1.000")])
def test_at_nyquist_the_phase_decides(phase: float, kept: str) -> None:
    shown = frame(frequency=0.5, phase=phase)
    assert texts_of(shown)["kept"] == kept
    row = light(shown)[0]
    assert (row.max() - row.min()) == pytest.approx(float(kept), abs=0.01)


def test_one_cycle_a_pixel_is_flat() -> None:
    shown = frame(frequency=1)
    assert np.ptp(pixels_of(shown)[..., 0].astype(int)) <= 1


def test_what_lies_exactly_on_the_fold_is_known_to_do_so_at_every_rate() -> None:
    for rate in np.arange(0.5, 2.01, 0.1).round(2):
        shown = frame(frequency=round(rate / 2, 2), rate=rate)
        assert "exactly at Nyquist" in shown.description, rate


def test_twice_the_samples_of_half_the_frequency_is_the_same_row() -> None:
    """As many samples to a cycle: on the finer grid there are twice as many of them."""
    coarse, fine = light(frame(frequency=0.8)), light(frame(frequency=1.2, rate=1.5))
    np.testing.assert_allclose(coarse[0], fine[0, :64], atol=0.01)


def test_the_ring_at_nyquist_is_where_the_plate_has_half_a_cycle_a_sample() -> None:
    given = SCENE.check({"pattern": "zone_plate", "frequency": 0.8, "rate": 1.2})
    done = SCENE.run(given, "", StageCache())
    (handle,) = (each for each in SCENE.handles if each.name == "ring")
    place = handle.at(given, done.outputs)
    assert place is not None
    pattern = pattern_of("zone_plate", 0.8, 0.0, 1.2)
    sample = place[0] / 400 * pattern.width - 0.5 * pattern.width
    assert abs(pattern.local_frequency(sample)) == pytest.approx(0.5)
