"""While a control of a lens moves, one sharp picture stands in for those that it would draw."""

from typing import Any

import numpy as np
import pytest
from support.frames import computed_in, frame_of, pixels_of

from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.models.error_measures import root_mean_square
from simulations.scenes._still_life_camera.picture import SCALED
from simulations.scenes.camera.lens import margin_px, widest_barrel
from simulations.scenes.camera.scene import SCENE as CAMERA
from simulations.scenes.camera.settings import STRONGEST_BARREL
from simulations.scenes.camera.stages import BOWED
from simulations.scenes.depth_of_field.scene import SCENE as DEPTH_OF_FIELD

SCENES = [CAMERA, DEPTH_OF_FIELD]


def apart(scene: Scene[Any], tier: str, focus: float) -> float:
    """RMS in codes between the frame at rest and another at the same focus; pixels of the finer are
    merged."""
    given = {"aperture": 2.0, "focus": focus}
    rest, other = (pixels_of(frame_of(scene, name, **given)) for name in ("", tier))
    rows, columns, _ = other.shape
    merged = rest.reshape(rows, len(rest) // rows, columns, -1, 4).mean(axis=(1, 3))
    return float(root_mean_square(np.subtract(merged, other, dtype=np.float32)))


@pytest.mark.parametrize("scene", SCENES)
def test_the_draft_is_near_the_picture_at_rest(scene: Scene[Any]) -> None:
    assert apart(scene, SCALED, focus=10.0) <= (0 if scene is CAMERA else 3)
    for focus in (1.2, 3.2):
        assert apart(scene, SCALED, focus) < 5


@pytest.mark.parametrize("scene", SCENES)
def test_the_draft_draws_nothing_anew_but_the_blur(scene: Scene[Any]) -> None:
    cache = StageCache()
    for focus in (1.2, 3.2):
        shown = frame_of(scene, SCALED, cache, aperture=2.0, focus=focus)
        assert pixels_of(shown).any()
    computed = computed_in(shown)
    assert "defocus" in computed
    assert not {"pinhole rays", "surfaces", "light"} & set(computed)


def test_a_moving_focal_length_is_drawn_in_fewer_rays_at_the_same_size() -> None:
    (draft,) = {DEPTH_OF_FIELD.drafts_of("layered")["focal_length"]}
    assert apart(DEPTH_OF_FIELD, draft, focus=3.2) < 10


@pytest.mark.parametrize("tier", ["layers", "bent-rays", "aperture-rays"])
def test_a_moving_k1_is_answered_by_its_own_draft(tier: str) -> None:
    assert CAMERA.drafts_of(tier)["k1"] == BOWED


@pytest.mark.parametrize("focal_length", [24.0, 50.0, 135.0])
def test_from_end_to_end_of_k1_the_world_is_drawn_once(focal_length: float) -> None:
    cache = StageCache()
    frame_of(CAMERA, BOWED, cache, k1=0.4, focal_length=focal_length)
    for k1 in (0.1, 0.0, -0.1, -0.18, -0.25, -0.4):
        shown = frame_of(CAMERA, BOWED, cache, k1=k1, focal_length=focal_length)
        assert not {"pinhole rays", "surfaces", "light", "defocus"} & set(computed_in(shown))


@pytest.mark.parametrize("k1", [-0.4, -0.2, 0.0, 0.3])
def test_the_draft_is_the_picture_at_rest_but_for_what_blurs_in_from_the_margin(k1: float) -> None:
    rest, draft = (pixels_of(frame_of(CAMERA, tier, k1=k1)) for tier in ("", BOWED))
    assert root_mean_square(np.subtract(rest, draft, dtype=np.float32)) < 2.0


@pytest.mark.parametrize("focal_length", [24.0, 28.0, 35.0, 50.0, 135.0])
@pytest.mark.parametrize("focus", [1.0, 3.2, 10.0])
def test_no_k1_of_the_slider_needs_a_wider_margin(focal_length: float, focus: float) -> None:
    widest = margin_px(focal_length, focus, widest_barrel(focal_length, focus, STRONGEST_BARREL))
    for k1 in np.linspace(STRONGEST_BARREL, 0.4, 81):
        assert np.all(np.array(margin_px(focal_length, focus, float(k1))) <= widest)
