"""What models of geometry refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.geometry import (
    euler,
    homography_algebra,
    homography_estimation,
    quaternions,
    rotation_paths,
    rotations,
    transforms,
    transforms_3d,
)
from simulations.models.geometry.preserved_properties import measure_preservation

I3, NAN, INF = np.eye(3), np.nan, np.inf
TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""
SQUARE = np.array([(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (-2.0, 1.0)])
SEGMENTS = np.array([[(0.0, 0), (1, 0)], [(0, 1), (1, 1)]])
HIDDEN = [[(-5.0, 0), (-4, 0)]]
GOOD = (0.1, 0.2, 0.3)
MIRROR = np.diag([1.0, 1.0, -1.0])
POINTS = np.random.default_rng(4).uniform(-2, 2, (30, 3))
BLEND = rotation_paths.euler_blend
NO_SEQUENCE = ["", "xy", "xxy", "xyy", "xYz", "abc", "xyzx", "zYX"]
NO_ANGLES = [(0.0, 0.0), (0.0, INF, 0.0), (NAN, NAN, NAN), 1.0]
NO_SHARE = [NAN, INF, [0.5, 2e6], -1.1e6]
NO_SCALE = [0.0, -1.0, NAN, INF]
NO_AXIS = [(0, 0, 0), (NAN, 0, 1), (INF, 0, 0), [[1.0, 0, 0], [0, 0, 0]]]
NO_QUATERNION = [
    *((0, 0, 0, 0), (NAN, 0, 0, 1), (INF, 0, 0, 0)),
    *([[1.0, 0, 0, 0], [0.0, 0, 0, 0]], [[1.0, 0, 0, 0], [NAN, 1, 0, 0]]),
]
DRIFTED = [
    *(np.diag([1.0, 1.0, 0.0]), I3 * 1.001, I3 * NAN, np.stack([I3, I3 * 1.1])),
    *(I3 + 1.1e-6 * np.eye(3, k=1), I3 - 1.1e-6 * np.eye(3, k=1)),
]
MANY_NEAREST = [-I3, np.diag([1.0, 0, 0]), np.zeros((3, 3)), np.diag([1.0, 1e-13, 0.0])]
NO_MATRIX = [np.full((3, 3), NAN), np.where(np.eye(3, k=1), NAN, I3), np.eye(4), I3[:2]]
FAR_PAIRS = [(np.add(SQUARE, [far, 0]), SQUARE) for far in (1.1e100, -1.1e100, INF)]
FAR_PAIRS += [(SQUARE, np.add(SQUARE, [0, far])) for far in (1.1e100, INF)]
NO_PAIRS = [np.ones(shape) for shape in ((0, 2), (4, 3), (2,), (1, 4, 2))]
NO_POINTS = [POINTS[:2], POINTS[0], POINTS * NAN, -np.abs(POINTS) * 1e101]
NOT_3_BY_3 = [2.0, [1.0, 2.0, 3.0], np.eye(2), np.ones((2, 3, 3))]


def cut(polygon: Any) -> Any:
    return transforms.clip_half_plane(polygon, (1, 0, 0))


@each_of(
    ("legal: finite, at most 1e", cut, [[(1.1e150, 0)], [(0, 0), (-1.1e150, 0)], [(NAN, 0)]]),
    ("legal: finite, at", lambda line: transforms.clip_half_plane(SQUARE, line), [(1, INF, 0)]),
    (
        "w_minimum",
        lambda w: transforms.clip_to_visible(TILTED, SQUARE, w_minimum=w),
        [0.0, 1e-12, 1.0, -0.1, NAN],
    ),
    (
        "^seen .*; legal",
        lambda seen: transforms.clip_to_visible(TILTED, SQUARE, seen=seen),
        [(-1.0, 3.0), (NAN, 0.0)],
    ),
    ("legal", transforms.projective, [np.zeros(9), [*[1.0] * 8, NAN], [*[1.0] * 8, INF]]),
    ("legal: finite entries", lambda x: transforms.translation(x, 0), [INF, NAN]),
    ("scale", lambda scale: transforms.similarity(scale, 0, 0, 0), NO_SCALE),
    ("legal: three of x, y, z", lambda s: euler.to_matrix(s, GOOD), NO_SEQUENCE),
    ("sequence", lambda s: rotation_paths.rate_axes(s, GOOD), [*NO_SEQUENCE, "xyz"]),
    ("sequence", lambda s: BLEND(s, GOOD, GOOD, 0.5), NO_SEQUENCE),
    ("^angles_rad.+; legal: ", lambda a: rotation_paths.rate_axes("ZYX", a), NO_ANGLES),
    ("^start_rad.+; legal: ", lambda a: BLEND("ZYX", a, GOOD, [0.0, 0.5]), NO_ANGLES),
    ("^end_rad.+; legal: ", lambda a: BLEND("ZYX", GOOD, a, [0.0, 0.5]), NO_ANGLES),
    (r"^share .+; legal: at most 1e\+06", lambda s: BLEND("ZYX", GOOD, GOOD, s), NO_SHARE),
    (r"^share .+; legal: at most 1e", lambda s: rotation_paths.matrix_blend(I3, I3, s), NO_SHARE),
    ("share", lambda s: rotations.slerp(np.eye(4)[0], np.eye(4)[1], s), NO_SHARE),
    ("share", lambda s: rotations.nlerp(np.eye(4)[0], np.eye(4)[1], s), NO_SHARE),
    (r"^end of shape", lambda end: rotation_paths.matrix_blend(I3, end, 0.5), [np.eye(2)]),
    (
        r"^start of shape \(3, 4\); legal: \(4,\)",
        lambda start: rotation_paths.off_great_circle(np.eye(4)[0], start, np.eye(4)[1]),
        [np.eye(3, 4)],
    ),
    ("reflection", lambda R: euler.from_matrix(R, "ZYX"), [MIRROR]),
    ("reflection", rotations.logarithm, [MIRROR, np.stack([I3, MIRROR])]),
    ("differs from I", rotations.logarithm, DRIFTED),
    ("shape", rotations.check_rotation, [np.ones((3, 2)), np.ones(9), np.ones((4, 4))]),
    ("no single nearest rotation", rotations.nearest_rotation, MANY_NEAREST),
    ("legal", rotations.nearest_rotation, NO_MATRIX),
    ("axis", lambda axis: rotations.from_axis_angle(axis, 0.1), NO_AXIS),
    ("angle_rad", lambda a: rotations.from_axis_angle((0, 0, 1), [0.1, a]), [INF, NAN]),
    ("rotation_vector", rotations.exponential, [(NAN, 0, 0), (INF, 0, 0)]),
    ("rotation_vector", quaternions.from_rotation_vector, [(NAN, 0, 0)]),
    ("rotation_vector", quaternions.angle_and_axis, [[1.7e308, 1.7e308, 0], [0, INF, 0]]),
    ("quaternion", quaternions.normalise, NO_QUATERNION),
    ("h₃₃", homography_algebra.decompose, [np.diag([0.0, 1, 1]), I3[[0, 2, 1]]]),
    ("parts from", lambda x: homography_algebra.decompose(transforms.translation(x, 0)), [1e76]),
    ("parts from", lambda s: homography_algebra.decompose(np.diag([s, s, 1])), [1e-76, 1e76]),
    ("legal: with a finite inverse", homography_algebra.invert, [I3 * 5e-324]),
    ("segments: 0 of 2 visible", lambda s: measure_preservation(TILTED, s), [SEGMENTS - [9, 0]]),
    ("segments: 1 of 2", lambda s: measure_preservation(TILTED, [s, *HIDDEN]), [SEGMENTS[0]]),
    ("longer than a point", lambda s: measure_preservation(I3, [s, *SEGMENTS]), [np.zeros((2, 2))]),
    ("longer than", lambda H: measure_preservation(H, SEGMENTS), [np.diag([0.0, 1.0, 1.0])]),
    ("legal: finite, at", lambda pair: homography_estimation.estimate_affine(*pair), FAR_PAIRS),
    (r"legal: both \(N, 2\)", lambda p: homography_estimation.estimate_rigid(p, p), NO_PAIRS),
    ("source", lambda p: homography_estimation.estimate_homography(SQUARE, p), [SQUARE[:3]]),
    ("source", lambda p: homography_estimation.estimate_homography(p, SQUARE), [SQUARE * NAN]),
    ("scale .+; legal: above 0", lambda s: transforms_3d.similarity(s, I3, [0, 0, 0]), NO_SCALE),
    ("reflection", lambda R: transforms_3d.rigid(R, [0, 0, 0]), [MIRROR]),
    ("legal: finite entries", lambda t: transforms_3d.affine(MIRROR, t), [[NAN, 0, 0]]),
    (r"^matrix of .+ \(3, 3\)", lambda m: transforms_3d.affine(m, [0, 0, 0]), NOT_3_BY_3),
    (r"^R of .+ \(3, 3\)", lambda m: transforms_3d.rigid(m, [0, 0, 0]), NOT_3_BY_3),
    (r"^offset of .+ \(3,\)", transforms_3d.translation, [np.ones((1, 3)), 1.0]),
    (r"H of shape \(3, 3\)", lambda H: transforms_3d.apply_transform(H, POINTS), [I3]),
    (r"source .+; legal: \(N, 3\)", lambda p: transforms_3d.estimate_similarity(p, p), NO_POINTS),
    ("legal: equal", lambda p: transforms_3d.estimate_similarity(POINTS, p), [POINTS[:5]]),
)
def test_models_of_geometry_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_the_ends_of_the_ranges_are_legal() -> None:
    assert cut([(1e150, 0.0)]).tolist() == [[1e150, 0]]
    ends = np.array([(0.0, 0), (1e100, 0), (0, -1e100)])
    assert homography_estimation.estimate_affine(ends, ends)[1]
    start, end = quaternions.from_rotation_vector([(0, 0, 0), (0, 0, 1.0)])
    for blend in (rotations.slerp, rotations.nlerp):
        assert np.isfinite(blend(start, end, [-1e6, 1e6])).all()
