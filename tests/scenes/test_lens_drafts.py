"""While a control of a lens moves, one sharp picture stands in for those that it would draw."""

from typing import Any

import numpy as np
import pytest
from support.frames import computed_in, frame_of, pixels_of

from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.models.error_measures import root_mean_square
from simulations.scenes._still_life_camera import SCALED
from simulations.scenes.camera.scene import SCENE as CAMERA
from simulations.scenes.camera.stages import BOWED
from simulations.scenes.depth_of_field.scene import SCENE as DEPTH_OF_FIELD

BEFORE_THE_LENS = {"pinhole rays", "surfaces", "light"}


def apart(scene: Scene[Any], tier: str, focus: float) -> float:
    """RMS in codes between the frame at rest and another at the same focus; pixels of the finer are
    merged."""
    given = {"aperture": 2.0, "focus": focus}
    rest, other = (pixels_of(frame_of(scene, name, **given)) for name in ("", tier))
    rows, columns, _ = other.shape
    merged = rest.reshape(rows, len(rest) // rows, columns, -1, 4).mean(axis=(1, 3))
    return float(root_mean_square(np.subtract(merged, other, dtype=np.float32)))


@pytest.mark.parametrize(
    ("scene", "draft", "focus", "codes"),
    [
        (CAMERA, SCALED, 10.0, 0),
        (CAMERA, SCALED, 1.2, 5),
        (DEPTH_OF_FIELD, SCALED, 10.0, 3),
        (DEPTH_OF_FIELD, SCALED, 1.2, 5),
        (DEPTH_OF_FIELD, "coarse", 3.2, 10),
    ],
)
def test_a_draft_is_near_the_picture_at_rest(
    scene: Scene[Any], draft: str, focus: float, codes: float
) -> None:
    assert apart(scene, draft, focus) <= codes


@pytest.mark.parametrize(
    ("scene", "draft", "control", "values"),
    [
        (CAMERA, SCALED, "focus", (1.2, 3.2)),
        (CAMERA, BOWED, "k1", (0.4, 0.0, -0.18, -0.4)),
        (DEPTH_OF_FIELD, SCALED, "focus", (1.2, 3.2)),
    ],
)
def test_a_draft_draws_the_world_once(
    scene: Scene[Any], draft: str, control: str, values: tuple[float, ...]
) -> None:
    assert scene.drafts_of(scene.default_tier)[control] == draft
    for focal_length in (24.0, 135.0) if control == "k1" else (50.0,):
        cache = StageCache()
        for number, value in enumerate(values):
            given = {"aperture": 2.0, "focal_length": focal_length, control: value}
            shown = frame_of(scene, draft, cache, **given)
            assert number == 0 or not BEFORE_THE_LENS & set(computed_in(shown))


@pytest.mark.parametrize("k1", [-0.4, -0.2, 0.0, 0.3])
def test_a_bowed_draft_differs_by_what_blurs_in_from_the_margin(k1: float) -> None:
    rest, draft = (pixels_of(frame_of(CAMERA, tier, k1=k1)) for tier in ("", BOWED))
    assert root_mean_square(np.subtract(rest, draft, dtype=np.float32)) < 2.0
