"""A reader's own picture in the aliasing figure: filtered, sampled and judged as theory has it."""

import numpy as np
import pytest
from numpy.typing import NDArray
from support.frames import number_of, pixels_of

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.scenes.aliasing.own import own_light, sample_own
from simulations.scenes.aliasing.scene import SCENE
from simulations.scenes.aliasing.settings import FILTERS


def own(codes: NDArray[np.uint8]) -> Photograph:
    return Photograph(1, codes)


def waves(cycles_per_pixel: float) -> Photograph:
    """Vertical stripes, with five points of the picture to a pixel."""
    x = (np.arange(320) + 0.5) / 5
    wave = 0.5 + 0.4 * np.cos(2 * np.pi * cycles_per_pixel * x)
    codes = np.rint(255 * encode_srgb(wave)).astype(np.uint8)
    return own(np.broadcast_to(codes[:, None], (240, 320, 3)).copy())


def told_of_own(picture: Photograph, **given: object) -> tuple[Frame, float]:
    settings, cache = SCENE.check(given), StageCache()
    (estimate,) = SCENE.estimates(settings, "", cache, picture)
    return SCENE.render(settings, "", cache, picture), number_of(estimate.text)


@pytest.mark.parametrize("kind", FILTERS)
@pytest.mark.parametrize("rate", [0.5, 1.0, 1.7])
def test_every_filter_leaves_an_even_picture_as_it_is(kind: str, rate: float) -> None:
    shown = sample_own(own_light(own(np.full((240, 320, 3), 99, np.uint8))), kind, rate)
    assert shown is not None
    assert (shown.raster[..., :3] == 99).all()


def test_a_picture_of_waves_above_nyquist_shows_their_alias_and_a_wide_filter_removes_it() -> None:
    shown, wrong = told_of_own(waves(0.8))
    row = decode_srgb(pixels_of(shown)[20, :, 0] / 255.0)
    spectrum = np.abs(np.fft.rfft(row - row.mean()))
    assert np.argmax(spectrum) == round(0.2 * 64)
    # An amplitude of 0.4 has an RMS of 0.4/√2.
    assert wrong == pytest.approx(0.4 / np.sqrt(2), rel=0.15)
    _, filtered = told_of_own(waves(0.8), prefilter="sinc")
    assert filtered < wrong / 10


def test_a_picture_of_waves_that_the_grid_can_hold_is_right_and_so_is_a_denser_grid() -> None:
    _, held = told_of_own(waves(0.25))
    assert held < 0.03
    _, denser = told_of_own(waves(0.8), rate=2)
    assert denser < 0.15


def test_of_a_reader_s_picture_nothing_is_said_that_holds_for_the_patterns_only() -> None:
    for pattern in ("stripes", "zone_plate"):
        shown, _ = told_of_own(waves(0.3), pattern=pattern, frequency=0.7, phase=0)
        assert shown.description.startswith("Your own picture at one sample a pixel")
        assert "alias" not in shown.panels[1].overlay
        assert {place.name for place in shown.handles} == {"frequency", "nyquist"}
