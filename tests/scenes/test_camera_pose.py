"""The pose figure: p′ = R p + t with a camera that is moved and panned."""

import numpy as np
import pytest

from simulations.models.projection.pinhole import look_at
from simulations.scenes.camera_pose import HEIGHT, WALLS, WIDTH, in_world, standpoint, to_camera


@pytest.mark.parametrize("pan", [-180, -90, -55, 0, 33, 90])
@pytest.mark.parametrize("place", [(0, -2), (0, 6), (12, -2), (12, 6), (4, 2.5)])
def test_the_pose_is_that_of_a_level_camera(pan: float, place: tuple[float, float]) -> None:
    here = standpoint(pan, *place)
    centre = np.array([place[0], 0.0, place[1]])
    ahead = np.array([np.sin(np.radians(pan)), 0.0, np.cos(np.radians(pan))])
    np.testing.assert_allclose(here.pose, look_at(centre, centre + ahead, (0, -1, 0)), atol=1e-12)
    np.testing.assert_allclose(here.centre, centre, atol=1e-12)
    field = here.seen(here.field)
    assert (np.abs(field[:, 0]) <= np.tan(np.radians(30)) * field[:, 2] + 1e-9).all()
    assert (here.field >= WALLS[0] - 1e-9).all()
    assert (here.field <= WALLS[2] + 1e-9).all()
    for panel in (in_world, to_camera(here)):
        corners = panel(WALLS)
        assert (corners > 0.0).all(), "the whole room is shown"
        assert (corners < [WIDTH, HEIGHT]).all()
