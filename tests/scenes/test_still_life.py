"""The still life of the title page: focus, floor and draft."""

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of

from simulations.pictures.still_life.things import THINGS, thing_depth
from simulations.scenes._still_life_camera import floor_depth, floor_tangent
from simulations.scenes.still_life import (
    COLUMNS,
    DRAFT,
    HEIGHT,
    SCENE,
    UNITS_PER_TANGENT,
    WIDTH,
    Settings,
    disc_width,
    floor_row,
)

BY_NAME = {thing.name: thing for thing in THINGS}


def test_the_floor_has_another_depth_in_its_row() -> None:
    depth = outputs_of(SCENE)["light"].base_depth[:, 3]
    for wanted in (2.0, 3.0, 5.0):
        row = floor_row(wanted) * len(depth) / HEIGHT
        assert np.interp(row - 0.5, np.arange(len(depth)), depth) == pytest.approx(wanted, rel=0.01)
        assert floor_depth(floor_tangent(wanted)) == pytest.approx(wanted)
    assert floor_depth(-0.1) == np.inf


@pytest.mark.parametrize("name", ["red ball", "striped ball", "green ball"])
def test_a_press_on_a_thing_focuses_elsewhere(name: str) -> None:
    x, _, top = BY_NAME[name].solid.centre
    depth = thing_depth(BY_NAME[name])
    across = WIDTH / 2 + UNITS_PER_TANGENT * x / depth
    down = floor_row(depth) - UNITS_PER_TANGENT * top / depth
    focus = SCENE.pull(Settings(), "aim", (across, down))["focus"]
    assert float(focus) == pytest.approx(depth, abs=0.05)


def test_the_striped_ball_is_sharper_out_of_focus() -> None:
    depth = thing_depth(BY_NAME["striped ball"])

    def contrast(focus: float) -> float:
        picture = pixels_of(frame_of(SCENE, focus=focus)).astype(float)
        x = int((0.5 - 0.1 * UNITS_PER_TANGENT / depth / WIDTH) * COLUMNS)
        y = int((floor_row(depth) - 80.0) / WIDTH * COLUMNS)
        window = picture[y - 60 : y + 60, x - 60 : x + 60, :3]
        return float((np.diff(window, axis=0) ** 2).mean())

    assert contrast(depth) > 1.2 * max(contrast(2.0), contrast(7.0))
    assert disc_width(2.0, 3.2, 3.2) == 0.0
    assert disc_width(4.0, 3.2, 8.0) == pytest.approx(disc_width(2.0, 3.2, 8.0) / 2)


def test_the_draft_differs_from_the_picture_at_rest() -> None:
    full, draft = (pixels_of(frame_of(SCENE, tier)) for tier in ("", DRAFT))
    rows, columns, _ = draft.shape
    assert (full.shape[1], columns) == (COLUMNS, COLUMNS // 2)
    merged = full.reshape(rows, 2, columns, 2, 4).mean(axis=(1, 3))
    assert np.abs(merged - draft).mean() < 2.0


def test_the_line_on_the_floor_crosses_things_in_front() -> None:
    behind, before = (
        frame_of(SCENE, focus=focus).panels[0].overlay.count("M") for focus in (3.2, 1.8)
    )
    assert behind > before
