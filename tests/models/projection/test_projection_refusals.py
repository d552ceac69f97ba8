"""What models of projection refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.projection import affine_cameras, pinhole, two_views
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.view_homographies import plane_between_views, turned_camera

NAN, INF = np.nan, np.inf
K = pinhole.intrinsics((800.0, 820.0), (320.0, 240.0), skew=3.0)
ORIGIN, AHEAD, I3 = (0, 0, 0), (0, 0, 1), np.eye(3)
NOT_IN_FRONT = [0.0, -1.0, INF, NAN]
NO_FOCAL = [0.0, (5.0, -1.0), NAN, INF, (0.0, 5.0), (5.0, 0.0), (INF, 5.0), (5.0, INF)]
NO_UP = [(0, INF, 0), (0, 1e-10, 1), (0, 0, -1), (0, 0, 0)]
NO_BASELINE = [(0.0, 0.0, 0.0), (NAN, 0.0, 1.0), (INF, 0.0, 0.0)]
THROUGH = [[0, 0, 1, 0], [1, 1, 0, 1e-13], [0, 0, 0, 0], [NAN, 0, 1, 1], [0, 0, 1, INF]]
DIVIDES = [np.eye(3, 4), np.eye(4), np.diag([1, 1, 1, 2])[:3]]
HALF = (0.85e308, 0.85e308, 0)


@each_of(
    ("focal_px", lambda focal: pinhole.intrinsics(focal, (0, 0)), NO_FOCAL),
    ("principal_point", lambda c: pinhole.intrinsics(1.0, c), [(NAN, 0), (0, INF)]),
    ("skew", lambda skew: pinhole.intrinsics(1.0, (0, 0), skew), [INF]),
    ("focal_mm", lambda focal: pinhole.field_of_view_rad(focal, 36.0), [0.0, -1.0, NAN]),
    ("sensor_mm", lambda mm: pinhole.field_of_view_rad(50.0, mm), [0.0, -1.0, INF, NAN]),
    (
        "target",
        lambda at: pinhole.look_at(ORIGIN, at, (0, 1, 0)),
        [ORIGIN, (INF, 0, 0), (NAN, 0, 0)],
    ),
    ("target: .* legal: positive", lambda x: pinhole.look_at(ORIGIN, (x, x, 0), AHEAD), [1.7e308]),
    ("eye .* largest number", lambda x: pinhole.look_at((x, x, 0), HALF, AHEAD), [1.7e308]),
    ("up", lambda up: pinhole.look_at(ORIGIN, AHEAD, up), NO_UP),
    ("up .* legal: finite, not zero", lambda up: pinhole.look_at(ORIGIN, AHEAD, up), [ORIGIN]),
    ("in front of", lambda z: affine_cameras.scaled_orthographic_camera(K, z), NOT_IN_FRONT),
    ("in front of", lambda z: affine_cameras.paraperspective_camera(K, [1, 0, z]), NOT_IN_FRONT),
    ("pixels_per_unit", affine_cameras.orthographic_camera, [0.0, -1.0, INF, NAN]),
    ("finite", lambda x: affine_cameras.paraperspective_camera(K, [x, 0.0, 1e-10]), [1e300]),
    ("finite", lambda x: affine_cameras.orthographic_camera(1.0, (x, 0.0)), [NAN]),
    ("last row 0, 0, 0, 1", lambda P: affine_cameras.project_affine([1, 2, 3], P), DIVIDES),
    ("height 0", lambda height: pose_above_ground(height, 0, 0, 0), [0.0]),
    ("finite", lambda yaw: pose_above_ground(1.0, yaw, 0, 0), [NAN]),
    ("pitch 1.6", lambda pitch: pose_above_ground(1.0, 0, pitch, 0), [1.6]),
    ("finite", lambda roll: pose_above_ground(1.0, 0, 0, roll), [INF]),
    ("t .*legal: finite, not zero", lambda t: two_views.essential_matrix(I3, t), NO_BASELINE),
    ("above 0", lambda f: two_views.depth_from_disparity(1.0, f, 1.0), [0.0, INF]),
    ("above 0", lambda b: two_views.depth_from_disparity(1.0, 800.0, b), [0.0]),
    ("above 0", lambda f: two_views.depth_error(1.0, f, 1.0, 0.5), [0.0, INF]),
    ("above 0", lambda b: two_views.depth_error(1.0, 800.0, b, 0.5), [0.0]),
    ("not through the first camera", lambda p: plane_between_views(K, K, np.eye(4), p), THROUGH),
    ("reflection", lambda R: turned_camera(K, K, R), [np.diag([1.0, 1.0, -1.0])]),
    (r"K of shapes \(3, 4\)", lambda first: turned_camera(first, K, I3), [np.eye(3, 4)]),
)
def test_models_of_projection_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_a_plane_hardly_beside_the_camera_is_still_one() -> None:
    near = plane_between_views(K, K, np.eye(4), [0.0, 0.6, 0.8, -1e-11])
    assert np.isfinite(near).all()
