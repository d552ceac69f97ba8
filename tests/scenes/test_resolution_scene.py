"""What is left of waves in the resolution figure, against convolutions done here."""

from collections.abc import Iterator
from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, texts_of

from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import lens_transfer
from simulations.scenes.resolution.scene import SCENE
from simulations.scenes.resolution.stages import CYCLES, columns, light_of, radius_um

STEP_UM, ACROSS = 0.5, 1024
"""Of the grid on which the truth is worked out."""


frame = partial(frame_of, SCENE)


outputs = partial(outputs_of, SCENE)


def number(name: str, **given: object) -> float:
    return float(texts_of(frame(**given))[name])


def measured_star(aperture: float, defocus: float, pitch: float, plate: bool) -> Floats:
    """The lower right quarter of the star, smeared as a whole by its spectrum, then sampled."""
    along = (np.arange(ACROSS) - ACROSS // 2) * STEP_UM
    x, y = np.meshgrid(along, along)
    star = np.cos(CYCLES * np.arctan2(y, x)) * (np.hypot(x, y) > 9)
    f = np.fft.fftfreq(ACROSS, STEP_UM / 1000)
    table = np.linspace(0, 1500, 3001)
    lens = lens_transfer(table, 0.55, aperture, defocus)
    factor = np.interp(np.hypot(f, f[:, None]), table, lens)
    one = np.sinc(f * pitch / 1000) * (np.cos(np.pi * f * pitch / 1000) if plate else 1)
    smeared = np.fft.ifft2(np.fft.fft2(star) * factor * one * one[:, None]).real
    columns_shown = columns(pitch)
    across, down = (
        ACROSS // 2 + np.rint(half(count) * pitch / STEP_UM).astype(int)
        for count in (columns_shown, 3 * columns_shown // 4)
    )
    shown: Floats = 0.5 + 0.5 * smeared[down][:, across]
    return shown


def half(count: int) -> Floats:
    """Of pixels around the middle, those from it on: an odd count has one there."""
    return np.arange(count // 2 + count % 2) + 0.5 * (1 - count % 2)


@pytest.mark.parametrize(
    ("aperture", "defocus", "pitch", "plate"),
    [(8, 0, 2, False), (4, 0, 4, False), (4, 0, 4, True), (16, 0, 4, False), (2.8, 30, 2, False)],
)
def test_the_star_is_what_smearing_it_as_a_whole_makes_of_it(
    aperture: float, defocus: float, pitch: float, plate: bool
) -> None:
    """Bent and narrowing waves are treated as plane ones: off by a hundredth of the range."""
    given = outputs(aperture=aperture, defocus=defocus, pitch=pitch, plate=plate)
    ours = light_of(given["lens"], given["star"])
    truth = measured_star(aperture, defocus, pitch, plate)
    inner = (slice(0, int(100 / pitch)), slice(0, int(150 / pitch)))
    off = (ours - truth)[inner]
    assert np.sqrt(np.mean(off**2)) < 0.002
    assert np.abs(off).max() < 0.01


def test_the_contrast_on_a_circle_of_the_star_is_the_lens_s() -> None:
    """With pixels of 1 µm, whose own factor is near 1."""
    radius = radius_um(100)
    given = outputs(aperture=8, pitch=1)
    x, y = (np.arange(n) + 0.5 for n in (200, 150))
    near = np.abs(np.hypot(x, y[:, None]) - radius) < 1
    light = light_of(given["lens"], given["star"])[near]
    seen = np.ptp(light) / (light.max() + light.min())
    assert seen == pytest.approx(number("together", aperture=8, pitch=1, frequency=100), abs=0.02)


def test_at_mtf50_half_is_left() -> None:
    for pitch in (2, 4, 8):
        half = number("mtf50", aperture=5.6, pitch=pitch)
        near = [number("together", aperture=5.6, pitch=pitch, frequency=f) for f in around(half)]
        assert near[0] >= 0.5 >= near[1]


def around(frequency: float) -> Iterator[float]:
    """The slider's steps below and above."""
    below = 5 * int(frequency // 5)
    yield from (below, below + 5)


def test_the_plate_leaves_nothing_at_nyquist() -> None:
    assert number("at_nyquist", aperture=2.8) > 0.4
    assert number("at_nyquist", aperture=2.8, plate=True) == 0


def test_beyond_the_cut_off_no_pixel_sees_anything() -> None:
    given = outputs(aperture=22, pitch=1)
    beyond = given["star"].frequency > 1000 / (0.55 * 22)
    assert (light_of(given["lens"], given["star"])[beyond] == 0.5).all()


def test_out_of_focus_dark_and_light_are_exchanged_in_words_and_in_the_star() -> None:
    setting = {"aperture": 2.8, "defocus": 60, "pitch": 1}
    assert "exchanged" in frame(**setting, frequency=100).description
    given = outputs(**setting)
    row = light_of(given["lens"], given["star"])[0] - 0.5  # along a light ray, nearly
    at = int(radius_um(100))
    assert row[at] < -0.02
    assert row[-1] > 0.15
