"""The wagon wheel: what the film shows of a motion, and what it cannot tell."""

import numpy as np
import pytest

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache
from simulations.scenes.wagon_wheel import SCENE, frame_at


def frame(cache=None, **values):
    return SCENE.render(check_values(SCENE.controls, values), "", cache or StageCache())


def texts(shown):
    return {item.name: item.text for item in shown.readouts}


def test_the_example_of_the_chapter_creeps_backwards():
    shown = texts(frame(speed=2.9, spokes=8, frame_rate=24))
    assert shown["passing"] == "23.2"
    assert (shown["apparent"], shown["direction"]) == ("−0.10", "turn anticlockwise")


def test_the_question_of_the_chapter_turns_forwards():
    shown = texts(frame(speed=5, spokes=6, frame_rate=24))
    assert (shown["apparent"], shown["direction"]) == ("+1.00", "turn clockwise")


def test_a_whole_spacing_stands_still():
    shown = frame(speed=3, spokes=8, frame_rate=24)
    assert texts(shown)["direction"] == "stand still"
    pictures = [
        frame(speed=3, spokes=8, frame_rate=24, time=time).panels[1].raster.astype(int)
        for time in (4, 17)
    ]
    assert np.abs(pictures[0] - pictures[1]).max() <= 1


@pytest.mark.parametrize("speed", [-4.5, -1.5, 1.5, 4.5])
def test_half_a_spacing_could_be_either_way(speed):
    shown = frame(speed=speed, spokes=8, frame_rate=24)
    assert texts(shown)["apparent"] == "±1.50"
    assert texts(shown)["direction"] == "turn either way"
    assert "nothing in the film says which way" in shown.description


def test_two_speeds_one_film():
    """The alias is no trick of the eye: without blur the frames themselves are the same."""
    for time in (1, 7, 30):
        fast, slow = (
            frame(speed=speed, spokes=8, frame_rate=24, shutter=0, time=time)
            for speed in (2.9, -0.1)
        )
        off = np.abs(fast.panels[1].raster.astype(int) - slow.panels[1].raster.astype(int))
        assert off.max() <= 1


def test_a_frame_is_held_until_the_next():
    cache = StageCache()
    first = frame(cache, time=5.0).panels[1].raster
    assert frame(cache, time=5.95).panels[1].raster is first
    assert frame(cache, time=6.0).panels[1].raster is not first


def test_time_that_is_a_rounding_short_of_a_frame_shows_it():
    assert frame_at(np.nextafter(7.0, 0)) == 7


def test_a_long_exposure_hides_the_spokes():
    shown = frame(speed=3, spokes=8, frame_rate=24, shutter=1)
    assert texts(shown)["contrast"] == "0.00"
    raster = shown.panels[1].raster
    circle = raster[120, 160 + 40 : 160 + 44, 0].astype(int)
    turned = raster[120 - 44 : 120 - 40, 160, 0].astype(int)
    np.testing.assert_allclose(circle, turned[::-1], atol=2)


@pytest.mark.parametrize("speed", [-6, 0, 6])
@pytest.mark.parametrize("spokes", [2, 16])
@pytest.mark.parametrize("rate", [8, 60])
@pytest.mark.parametrize("time", [0, 48])
def test_every_extreme_can_be_drawn_in_the_same_layout(speed, spokes, rate, time):
    shown = frame(speed=speed, spokes=spokes, frame_rate=rate, time=time, shutter=1)
    assert [panel.name for panel in shown.panels] == ["wheel", "film", "track"]
    assert len(shown.readouts) == 8
    assert not any("nan" in panel.overlay for panel in shown.panels)
