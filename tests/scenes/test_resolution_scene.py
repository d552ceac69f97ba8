"""Waves in the resolution figure against convolutions of a whole star."""

from functools import partial

import numpy as np
import pytest
from support.frames import outputs_of

from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import lens_transfer
from simulations.scenes.resolution.links import CYCLES, columns, light_of
from simulations.scenes.resolution.scene import SCENE

STEP_UM, ACROSS = 0.5, 1024  # of the grid on which the truth is computed
outputs = partial(outputs_of, SCENE)


def convolved_star(aperture: float, defocus: float, pitch: float, plate: bool) -> Floats:
    """The lower right quarter of the star, blurred as a whole by its spectrum, then sampled."""
    along = (np.arange(ACROSS) - ACROSS // 2) * STEP_UM
    x, y = np.meshgrid(along, along)
    star = np.cos(CYCLES * np.arctan2(y, x)) * (np.hypot(x, y) > 9)
    f = np.fft.fftfreq(ACROSS, STEP_UM / 1000)
    table = np.linspace(0, 1500, 3001)
    factor = np.interp(
        np.hypot(f, f[:, None]), table, lens_transfer(table, 0.55, aperture, defocus)
    )
    one = np.sinc(f * pitch / 1000) * (np.cos(np.pi * f * pitch / 1000) if plate else 1)
    blurred = np.fft.ifft2(np.fft.fft2(star) * factor * one * one[:, None]).real
    across, down = (
        ACROSS // 2 + np.rint(half(count) * pitch / STEP_UM).astype(int)
        for count in (columns(pitch), 3 * columns(pitch) // 4)
    )
    shown: Floats = 0.5 + 0.5 * blurred[down][:, across]
    return shown


def half(count: int) -> Floats:
    """Pixels from the middle on: an odd count has one there."""
    return np.arange(count // 2 + count % 2) + 0.5 * (1 - count % 2)


@pytest.mark.parametrize(
    ("aperture", "defocus", "pitch", "plate"),
    [(8, 0, 2, False), (4, 0, 4, False), (4, 0, 4, True), (16, 0, 4, False), (2.8, 30, 2, False)],
)
def test_star_agrees_with_its_convolution(
    aperture: float, defocus: float, pitch: float, plate: bool
) -> None:
    """Curved and narrowing waves are treated as plane, which errs by up to 1 % of the range."""
    given = outputs(aperture=aperture, defocus=defocus, pitch=pitch, plate=plate)
    truth = convolved_star(aperture, defocus, pitch, plate)
    inner = (slice(0, int(100 / pitch)), slice(0, int(150 / pitch)))
    off = (light_of(given["lens"], given["star"]) - truth)[inner]
    assert np.sqrt(np.mean(off**2)) < 0.002
    assert np.abs(off).max() < 0.01
