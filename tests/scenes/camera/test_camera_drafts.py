"""While k₁ moves, one straight picture with a wide margin is bent anew, as sharp as at rest."""

import numpy as np
import pytest
from support.frames import computed_in, frame_of, pixels_of

from simulations.engine.stages import StageCache
from simulations.models.error_measures import root_mean_square
from simulations.scenes.camera.lens import margin_px, widest_barrel
from simulations.scenes.camera.scene import SCENE
from simulations.scenes.camera.settings import STRONGEST_BARREL
from simulations.scenes.camera.stages import BOWED


@pytest.mark.parametrize("tier", ["layers", "bent-rays", "aperture-rays"])
def test_a_moving_k1_is_answered_by_its_own_draft(tier: str) -> None:
    assert SCENE.drafts_of(tier)["k1"] == BOWED


@pytest.mark.parametrize("focal_length", [24.0, 50.0, 135.0])
def test_from_end_to_end_of_k1_the_world_is_drawn_once(focal_length: float) -> None:
    cache = StageCache()
    frame_of(SCENE, BOWED, cache, k1=0.4, focal_length=focal_length)
    for k1 in (0.1, 0.0, -0.1, -0.18, -0.25, -0.4):
        shown = frame_of(SCENE, BOWED, cache, k1=k1, focal_length=focal_length)
        assert not {"pinhole rays", "surfaces", "light", "defocus"} & set(computed_in(shown))


@pytest.mark.parametrize("k1", [-0.4, -0.2, 0.0, 0.3])
def test_the_draft_is_the_picture_at_rest_but_for_what_blurs_in_from_the_margin(k1: float) -> None:
    rest, draft = (pixels_of(frame_of(SCENE, tier, k1=k1), 0) for tier in ("", BOWED))
    assert root_mean_square(np.subtract(rest, draft, dtype=np.float32)) < 2.0


@pytest.mark.parametrize("focal_length", [24.0, 28.0, 35.0, 50.0, 135.0])
@pytest.mark.parametrize("focus", [1.0, 3.2, 10.0])
def test_no_k1_of_the_slider_needs_a_wider_margin(focal_length: float, focus: float) -> None:
    widest = margin_px(focal_length, focus, widest_barrel(focal_length, focus, STRONGEST_BARREL))
    for k1 in np.linspace(STRONGEST_BARREL, 0.4, 81):
        assert np.all(np.array(margin_px(focal_length, focus, float(k1))) <= widest)
