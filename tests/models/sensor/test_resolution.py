"""Pixels and plates as factors, against waves averaged here."""

import numpy as np
import pytest

from simulations.models.sensor.resolution import (
    nyquist_per_mm,
    pixel_transfer,
    plate_transfer,
)


@pytest.mark.parametrize("frequency", [0, 30, 125, 250, 300, 410])
def test_a_pixel_leaves_the_mean_over_its_width(frequency: float) -> None:
    places_mm = (np.arange(20_000) + 0.5) / 20_000 * 0.004 - 0.002
    mean = np.cos(2 * np.pi * frequency * places_mm).mean()
    assert pixel_transfer(frequency, 4) == pytest.approx(mean, abs=1e-7)


@pytest.mark.parametrize("frequency", [0, 30, 125, 250])
def test_a_plate_leaves_the_mean_of_two_copies(frequency: float) -> None:
    mean = np.cos(2 * np.pi * frequency * np.array([-0.0015, 0.0015])).mean()
    assert plate_transfer(frequency, 3) == pytest.approx(mean, abs=1e-12)


def test_nyquist_is_half_a_cycle_to_a_pixel() -> None:
    assert nyquist_per_mm(4) == 125
    assert pixel_transfer(nyquist_per_mm(7), 7) == pytest.approx(2 / np.pi)
    assert plate_transfer(nyquist_per_mm(7), 7) == pytest.approx(0, abs=1e-15)


def test_no_width_leaves_the_wave_as_it_is() -> None:
    assert pixel_transfer(300, 0) == 1
    assert plate_transfer([-1e12, 1e12], 0).tolist() == [1, 1]
    assert pixel_transfer(500, 0.5) == pytest.approx(np.sinc(0.25))
