"""The still life of the title page: what is in focus stands on the line, and is sharp."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of

from simulations.pictures.still_life.things import THINGS, thing_depth
from simulations.scenes._still_life_camera.focus_plane import floor_depth, floor_tangent
from simulations.scenes.still_life.scene import SCENE
from simulations.scenes.still_life.settings import Settings
from simulations.scenes.still_life.stages import COLUMNS, DRAFT, DRAFT_COLUMNS
from simulations.scenes.still_life.view import (
    HEIGHT,
    UNITS_PER_TANGENT,
    WIDTH,
    disc_width,
    floor_row,
)

frame = partial(frame_of, SCENE)
STRIPED = next(thing for thing in THINGS if thing.name == "striped ball")
BY_NAME = {thing.name: thing for thing in THINGS}


def test_the_row_of_a_depth_is_where_the_floor_has_that_depth() -> None:
    depth = outputs_of(SCENE)["light"].base_depth[:, 3]
    for wanted in (2.0, 3.0, 5.0):
        row = floor_row(wanted) * len(depth) / HEIGHT
        assert np.interp(row - 0.5, np.arange(len(depth)), depth) == pytest.approx(wanted, rel=0.01)
        assert floor_depth(floor_tangent(wanted)) == pytest.approx(wanted)


def test_the_sky_has_no_floor() -> None:
    assert floor_depth(-0.1) == np.inf


@pytest.mark.parametrize("name", ["red ball", "striped ball", "green ball"])
def test_a_press_on_a_thing_focuses_on_it(name: str) -> None:
    x, _, _ = BY_NAME[name].solid.centre
    depth = thing_depth(BY_NAME[name])
    top = BY_NAME[name].solid.centre[2]
    across = WIDTH / 2 + UNITS_PER_TANGENT * x / depth
    down = floor_row(depth) - UNITS_PER_TANGENT * top / depth
    assert float(SCENE.pull(Settings(), "aim", (across, down))["focus"]) == pytest.approx(
        depth, abs=0.05
    )


def test_the_striped_ball_is_sharpest_when_the_focus_is_on_it() -> None:
    def contrast(focus: float) -> float:
        picture = pixels_of(frame(focus=focus)).astype(float)
        x = int((0.5 - 0.1 * UNITS_PER_TANGENT / thing_depth(STRIPED) / WIDTH) * COLUMNS)
        y = int((floor_row(thing_depth(STRIPED)) - 80.0) / WIDTH * COLUMNS)
        window = picture[y - 60 : y + 60, x - 60 : x + 60, :3]
        return float((np.diff(window, axis=0) ** 2).mean())

    sharpest = contrast(thing_depth(STRIPED))
    assert sharpest > 1.2 * max(contrast(2.0), contrast(7.0))


def test_discs_shrink_with_the_opening_and_vanish_in_focus() -> None:
    assert disc_width(2.0, 3.2, 3.2) == 0.0
    assert disc_width(4.0, 3.2, 8.0) == pytest.approx(disc_width(2.0, 3.2, 8.0) / 2)


def test_a_drag_draws_fewer_pixels_of_the_same_picture() -> None:
    full, draft = (pixels_of(frame_of(SCENE, tier)) for tier in ("", DRAFT))
    assert (full.shape[1], draft.shape[1]) == (COLUMNS, DRAFT_COLUMNS)
    rows, columns, _ = draft.shape
    merged = full.reshape(rows, 2, columns, 2, 4).mean(axis=(1, 3))
    assert np.abs(merged - draft).mean() < 2.0


def test_the_line_on_the_floor_stops_at_things_in_front() -> None:
    behind, before = (frame(focus=focus).panels[0].overlay.count("M") for focus in (3.2, 1.8))
    assert behind > before
