"""The slanted edge: what its readouts say, and where it says nothing."""

import pytest
from support.frames import texts_of

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.scenes.slanted_edge.drawing import angle_of, edge_end
from simulations.scenes.slanted_edge.scene import SCENE


def frame(**given: object) -> Frame:
    return SCENE.render(SCENE.check(given), "", StageCache())


@pytest.mark.parametrize("aperture", [4, 8, 11])
@pytest.mark.parametrize("angle", [3, 5, 8])
def test_the_edge_says_what_lens_and_pixel_say(aperture: float, angle: float) -> None:
    shown = texts_of(frame(angle=angle, aperture=aperture))
    assert float(shown["measured"]) == pytest.approx(float(shown["true"]), rel=0.05)


def test_an_upright_edge_says_nothing_and_the_figure_says_why() -> None:
    upright = frame(angle=0)
    assert texts_of(upright)["measured"] == "—"
    assert "no MTF" in upright.description


def test_the_edge_moves_by_one_pixel_in_as_many_rows_as_the_slant_says() -> None:
    assert texts_of(frame(angle=5))["rows"] == "11.4"


@pytest.mark.parametrize("angle", [0.0, 5.0, 20.0])
def test_the_handle_is_at_the_end_of_the_edge(angle: float) -> None:
    assert angle_of(edge_end(angle)) == pytest.approx(angle)
