"""Files of an even surface: their planes, their evenness, and their pairs."""

import numpy as np
import pytest
from numpy.typing import NDArray

from simulations.models.sensor.photon_transfer_file import (
    SRGB_DN,
    Taken,
    camera_of,
    pair_up,
    planes_of,
    unevenness,
)


def even(light: float, size: int = 64) -> NDArray[np.uint8]:
    grain = np.random.default_rng(1).normal(light, 3.0, (size, size))
    return np.clip(np.rint(grain), 0, 255).astype(np.uint8)


def test_a_grey_file_has_the_four_cells_of_a_mosaic() -> None:
    grey = np.repeat(np.arange(15, dtype=np.uint8).reshape(3, 5, 1), 3, axis=2)
    planes = planes_of(grey)
    assert [plane.tolist() for plane in planes.values()] == [[[0, 2]], [[1, 3]], [[5, 7]], [[6, 8]]]


def test_a_colour_file_has_three_channels() -> None:
    codes = np.zeros((3, 5, 3), np.uint8)
    codes[..., 2] = 9
    assert {name: plane.shape for name, plane in planes_of(codes).items()} == {
        "red": (3, 5),
        "green": (3, 5),
        "blue": (3, 5),
    }


def test_grain_and_fall_off_are_even_and_an_edge_is_not() -> None:
    assert unevenness(even(120.0)) < 0.01
    falling = even(120.0) - np.arange(64, dtype=np.uint8)[:, None]
    assert unevenness(falling) < 0.01
    edge = even(120.0)
    edge[:, 30:] //= 2
    assert unevenness(edge) > 0.1
    assert unevenness(np.zeros((64, 64), np.uint8)) == 0.0
    assert unevenness(np.zeros((5, 3), np.uint8)) == 0.0


def test_pairs_share_light_exposure_and_camera() -> None:
    taken = [
        Taken(50.0, "A", 0.1),
        Taken(100.0, "A", 0.2),
        Taken(51.0, "A", 0.1),
        Taken(101.0, "A", 0.4),
        Taken(99.0, "A", 0.2),
        Taken(50.0, "B", 0.1),
    ]
    assert pair_up(taken) == ((0, 2), (4, 1))


def test_without_exif_the_light_makes_the_pairs() -> None:
    lights = [0.1, 0.3, 40.0, 60.0, 41.0, 40.5, 61.0]
    assert pair_up([Taken(light) for light in lights]) == ((0, 1), (2, 5), (3, 6))
    assert pair_up([]) == ()


def test_white_is_white() -> None:
    assert SRGB_DN[0] == 0
    assert SRGB_DN[-1] == pytest.approx(255)


def test_the_camera_is_named_by_its_file() -> None:
    assert camera_of({"make": "Acme", "model": "X1", "iso": 400.0}) == "Acme, X1, ISO 400"
    assert camera_of({}) == ""
