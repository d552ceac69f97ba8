"""The formation pipeline: the numbers of the book's worked example, and the moving marker."""

import itertools
import math
import re

import numpy as np
import pytest

from simulations.models.color.srgb import encode_srgb
from simulations.scenes.formation_pipeline.scene import legs_of, travelled
from simulations.scenes.formation_pipeline.stations import (
    CELLS,
    WALL_ALBEDO,
    light_around,
    stations,
    travel,
)


def parts(pattern: str, line: str) -> tuple[str, ...]:
    """The groups of a pattern that matches the whole line."""
    found = re.fullmatch(pattern, line)
    assert found is not None, line
    return tuple(found.groups())


def test_electrons_scatter_like_photons_and_read_noise_adds_five() -> None:
    journeys = [travel(4.0, 0.6, exposure) for exposure in range(400)]
    counted, read = np.array([(each.counted_e, each.read_e) for each in journeys]).T
    assert counted.mean() == pytest.approx(3000, abs=4 * math.sqrt(3000 / 400))
    assert counted.var() == pytest.approx(3000, rel=0.3)
    assert read.mean() == pytest.approx(0, abs=4 * 5 / math.sqrt(400))
    assert read.std() == pytest.approx(5, rel=0.15)


@pytest.mark.parametrize("exposure", range(8))
def test_each_ledger_line_follows_from_the_printed_line_above(exposure: int) -> None:
    """At every albedo and in eight exposures."""
    for percent in range(101):
        *_, light, sensor, file = (
            item.numbers for item in stations(travel(4.0, percent / 100, exposure))
        )
        share, due = re.findall(r"[\d.]+", light)[1:]
        assert float(share) == pytest.approx(percent / 100 * 0.5, abs=5e-4)
        assert float(due) == pytest.approx(percent / 100 * 5000, abs=0.5)
        counted, sign, read, raw = parts(r"\((\d+) ([+−]) ([\d.]+)\) .* = code (\d+)", sensor)
        electrons = float(counted) + float(sign.replace("−", "-") + read)
        assert min(max(round(electrons * 4095 / 10_000), 0), 4095) == int(raw)
        again, code = parts(r"255 · sRGB\((\d+) / 4095\) = (\d+)", file)
        assert again == raw
        assert round(255 * float(encode_srgb(int(raw) / 4095))) == int(code)


@pytest.mark.parametrize("distance", [2.0, 4.0, 5.3, 8.0])
def test_places_in_the_ledger_follow_from_one_another(distance: float) -> None:
    """Within the rounding of the printed numbers."""
    lines = [item.numbers.replace("−", "-") for item in stations(travel(distance, 0.6, 0))[:5]]
    room, camera, ideal, bent, pixel = (
        [float(each) for each in parts(r".*?\(([^)]*)\).*", line)[0].split(",")] for line in lines
    )
    assert room == [0.4, -0.3, 3.0]
    assert camera == pytest.approx([room[0], room[1], distance], abs=1e-9)
    assert ideal == pytest.approx([camera[0] / camera[2], camera[1] / camera[2]], abs=6e-6)
    factor = 1 - 0.2 * (ideal[0] ** 2 + ideal[1] ** 2)
    assert bent == pytest.approx([factor * each for each in ideal], abs=2e-5)
    assert pixel == pytest.approx([320 + 800 * bent[0], 240 + 800 * bent[1]], abs=0.01)
    assert lines[4].endswith(f"in cell ({round(pixel[0])}, {round(pixel[1])})")


def test_marker_is_at_each_station_at_whole_numbers_and_never_jumps() -> None:
    legs = legs_of(4.0)
    for index, leg in enumerate(legs):
        assert travelled(legs, index)[-1] == pytest.approx(leg[0])
        assert travelled(legs, index + 1)[-1] == pytest.approx(leg[-1])
    way = [travelled(legs, step / 50)[-1] for step in range(50 * len(legs) + 1)]
    assert max(math.dist(a, b) for a, b in itertools.pairwise(way)) < 7


@pytest.mark.parametrize("distance", [2.0, 4.0, 8.0])
def test_sensor_tile_shows_the_paint_smaller_but_no_darker_from_afar(distance: float) -> None:
    """The cell in the middle shows paint only; the disc covers its true number of cells."""
    journey = travel(distance, 0.6, 0)
    light = light_around(journey)
    assert light[CELLS // 2, CELLS // 2] == pytest.approx(journey.relative_light)
    wall = WALL_ALBEDO / 2
    covered = float(((light - wall) / (journey.relative_light - wall)).sum())
    area = math.pi * (800 * 0.02 / distance) ** 2
    assert covered == pytest.approx(min(area, CELLS**2), rel=0.1)
