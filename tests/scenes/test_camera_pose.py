"""The pose figure: p′ = R p + t with a camera that is dragged and turned."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, texts_of

from simulations.models.projection.pinhole import look_at
from simulations.scenes.camera_pose.plans import HEIGHT, WIDTH, in_world, to_camera
from simulations.scenes.camera_pose.room import WALLS, standpoint
from simulations.scenes.camera_pose.scene import SCENE

frame = partial(frame_of, SCENE)


def test_the_figure_starts_with_the_worked_example() -> None:
    expected = look_at((10, 0, 2), (0, 0, 2), (0, -1, 0))
    np.testing.assert_allclose(standpoint(-90, 10, 2).pose, expected, atol=1e-12)
    assert texts_of(frame())["t"] == "(−2.0, 0.0, 10.0)"
    assert texts_of(frame())["lamp"] == "(3.0, −1.0, 8.0)"


@pytest.mark.parametrize("pan", [-180, -60, 0, 33, 90])
def test_t_is_the_worlds_origin_and_the_centre_is_where_the_camera_was_put(pan: float) -> None:
    here = standpoint(pan, 4.0, 2.5)
    np.testing.assert_allclose(here.t, here.seen(np.zeros(3)), atol=1e-12)
    np.testing.assert_allclose(here.centre, [4.0, 0.0, 2.5], atol=1e-12)


def test_turning_on_the_spot_changes_both_parts_of_the_pose() -> None:
    before, after = standpoint(-90, 10, 0), standpoint(-60, 10, 0)
    np.testing.assert_allclose(before.centre, after.centre, atol=1e-12)
    assert not np.allclose(before.rotation, after.rotation)
    assert not np.allclose(before.t, after.t)


@pytest.mark.parametrize("pan", [-180, -90, 0, 33])
def test_the_field_of_view_is_ahead_of_the_camera_and_inside_the_room(pan: float) -> None:
    here = standpoint(pan, 4.0, 2.5)
    seen = here.seen(here.field)
    assert len(seen) >= 3
    assert (np.abs(seen[:, 0]) <= np.tan(np.radians(30)) * seen[:, 2] + 1e-9).all()
    assert (here.field >= WALLS[0] - 1e-9).all()
    assert (here.field <= WALLS[2] + 1e-9).all()


@pytest.mark.parametrize("pan", [-150, -90, -55, 0, 35, 180])
@pytest.mark.parametrize("corner", [(0, -2), (0, 6), (12, -2), (12, 6), (10, 2)])
def test_the_whole_room_is_in_both_panels(pan: float, corner: tuple[float, float]) -> None:
    for place in (in_world, to_camera(standpoint(pan, *corner))):
        corners = place(WALLS)
        assert (corners > 0.0).all()
        assert (corners < [WIDTH, HEIGHT]).all()
