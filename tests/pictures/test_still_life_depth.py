"""The depth that a single ray meets, against the picture's own surfaces."""

import numpy as np
import pytest

from simulations.pictures.still_life.depth import depth_met
from simulations.pictures.still_life.surfaces import surfaces
from simulations.pictures.still_life.things import view
from simulations.scenes._still_life_camera.rays import COLUMNS, ROWS, sensor_rays


@pytest.mark.parametrize("focal_mm", [24.0, 85.0])
def test_a_ray_meets_what_the_picture_shows_there(focal_mm: float) -> None:
    rays = sensor_rays(focal_mm, 3.0).directions
    parts = surfaces(view(rays))
    rng = np.random.default_rng(0)
    sure = 0
    for row, column in zip(rng.integers(0, ROWS, 150), rng.integers(0, COLUMNS, 150), strict=True):
        shown = None
        for part in parts:  # from far to near: what covers the whole pixel is what is seen
            y, x = row - part.top, column - part.left
            if not (0 <= y < part.coverage.shape[0] and 0 <= x < part.coverage.shape[1]):
                continue
            if part.coverage[y, x] == 1:
                shown = part.depth[y, x]
            elif part.coverage[y, x] > 0:
                shown = None
        if shown is not None:
            sure += 1
            assert depth_met(rays[row, column]) == pytest.approx(shown, rel=1e-9)
    assert sure > 100


def test_edges_between_the_faces_of_a_box_are_shared_by_their_pixels() -> None:
    """Otherwise a slanted edge inside a box is a staircase."""
    box = surfaces(view(sensor_rays(50.0, 3.2).directions))[-2]
    inside = box.coverage == 1
    length = np.linalg.norm(box.normals, axis=-1)[inside]
    assert length.max() == pytest.approx(1.0)
    assert 30 < np.count_nonzero(length < 0.99) < 0.1 * length.size
