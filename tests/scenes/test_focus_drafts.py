"""While the focus moves, one sharp picture stands in for those that the lens would draw."""

from typing import Any

import numpy as np
import pytest
from support.frames import computed_in, frame_of, pixels_of

from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.models.error_measures import root_mean_square
from simulations.scenes._still_life_camera.picture import SCALED
from simulations.scenes.camera.scene import SCENE as CAMERA
from simulations.scenes.depth_of_field.scene import SCENE as DEPTH_OF_FIELD

PICTURES = [(CAMERA, 0), (DEPTH_OF_FIELD, 1)]
"""Scenes, and which of their panels is the picture."""


def apart(scene: Scene[Any], panel: int, tier: str, focus: float) -> float:
    """RMS in codes between the frame at rest and another at the same focus."""
    given = {"aperture": 2.0, "focus": focus}
    rest, other = (pixels_of(frame_of(scene, name, **given), panel) for name in ("", tier))
    return float(root_mean_square(np.subtract(rest, other, dtype=np.float32)))


@pytest.mark.parametrize(("scene", "panel"), PICTURES)
def test_the_draft_is_near_the_picture_at_rest(scene: Scene[Any], panel: int) -> None:
    assert apart(scene, panel, SCALED, focus=10.0) == 0
    for focus in (1.2, 3.2):
        assert apart(scene, panel, SCALED, focus) < 5


@pytest.mark.parametrize(("scene", "panel"), PICTURES)
def test_the_draft_draws_nothing_anew_but_the_blur(scene: Scene[Any], panel: int) -> None:
    cache = StageCache()
    for focus in (1.2, 3.2):
        shown = frame_of(scene, SCALED, cache, aperture=2.0, focus=focus)
        assert pixels_of(shown, panel).any()
    computed = computed_in(shown)
    assert "defocus" in computed
    assert not {"pinhole rays", "surfaces", "light"} & set(computed)


def test_a_moving_focal_length_is_drawn_in_fewer_rays_at_the_same_size() -> None:
    (draft,) = {DEPTH_OF_FIELD.drafts_of("layered")["focal_length"]}
    assert apart(DEPTH_OF_FIELD, 1, draft, focus=3.2) < 10
