"""The corner at infinity: w falls to 0 in the plot where the image of P leaves the plane."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, texts_at

from simulations.engine.stages import StageCache
from simulations.scenes._mapped_square.family import transformation
from simulations.scenes.lost_corner.divisor import PLOT
from simulations.scenes.lost_corner.scene import SCENE

frame = partial(frame_of, SCENE)
texts = partial(texts_at, SCENE)


@pytest.mark.parametrize("amount", [0, 34, 57, 58, 100])
def test_w_at_the_corner_is_that_of_the_chapter(amount: float) -> None:
    expected = 1 - amount * 40 / 10000 - amount * 40 / 3000
    assert float(texts(amount=amount)["w"].replace("−", "-")) == pytest.approx(expected, abs=6e-4)


def test_the_area_has_no_bound_once_the_corner_is_past_infinity() -> None:
    assert texts(amount=57)["area"] != "∞"
    assert texts(amount=58)["area"] == "∞"


def test_the_handle_of_the_plot_is_at_the_amount_and_its_w() -> None:
    spot = next(place for place in frame(amount=50).handles if place.name == "amount")
    w = transformation("projective", 50.0)[2] @ [40, -40, 1]
    np.testing.assert_allclose((spot.x, spot.y), PLOT.at(50, w), atol=0.01)
    assert SCENE.pull(SCENE.check({}), "amount", PLOT.at(70, 0.0)) == {"amount": 70}


@pytest.mark.parametrize("amount", [20, 45, 75])
def test_the_image_follows_its_pull_along_the_path(amount: float) -> None:
    there = SCENE.render(SCENE.check({"amount": amount}), "", StageCache())
    spot = next((place for place in there.handles if place.name == "image"), None)
    assert spot is not None
    if 0 < spot.x < 400 and 0 < spot.y < 340:
        assert SCENE.pull(SCENE.check({}), "image", (spot.x, spot.y)) == {"amount": amount}
