"""The slanted edge: what its readouts say, and where it says nothing."""

from functools import partial

import pytest
from support.frames import frame_of, texts_of

from simulations.scenes.slanted_edge.scene import SCENE

frame = partial(frame_of, SCENE)


@pytest.mark.parametrize("aperture", [4, 8, 11])
@pytest.mark.parametrize("angle", [3, 5, 8])
def test_the_edge_says_what_lens_and_pixel_say(aperture: float, angle: float) -> None:
    shown = texts_of(frame(angle=angle, aperture=aperture))
    assert float(shown["measured"]) == pytest.approx(float(shown["true"]), rel=0.05)
