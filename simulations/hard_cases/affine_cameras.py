"""Points behind a camera with parallel rays, and scales that it cannot have."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, invalid, refused, valid
from simulations.models.projection import affine_cameras, pinhole

K = pinhole.intrinsics(800.0, (320.0, 240.0))

TABLE = HardCases(
    id="affine-cameras",
    title="Affine cameras",
    names={
        **vars(affine_cameras),
        **vars(pinhole),
        "K": K,
        "P": pinhole.camera_matrix(K, np.eye(4)),
        "inf": np.inf,
    },
    cases=(
        HardCase(
            id="behind-a-parallel-camera",
            call="project_affine([1.0, 0.5, -2.0], scaled_orthographic_camera(K, 5.0))",
            why="Behind the camera's centre, but the rays of this camera are parallel.",
            returns="A pixel: its true centre is infinitely far away, and nothing is behind that.",
            expected=valid([480.0, 320.0]),
        ),
        HardCase(
            id="beside-a-parallel-camera",
            call="project_affine([1.0, 0.0, 0.0], scaled_orthographic_camera(K, 5.0))",
            why="Depth 0, by which perspective would divide.",
            returns="A pixel: this camera divides by the depth of its reference only.",
            expected=valid([480.0, 240.0]),
            naive="800 * np.divide(1.0, 0.0) + 320",
        ),
        HardCase(
            id="reference-in-the-camera-plane",
            call="scaled_orthographic_camera(K, 0.0)",
            why="The scale f/Z₀ is infinite.",
            returns="Refused.",
            expected=refused("depth 0.0"),
            naive="800 / np.float64(0.0)",
        ),
        HardCase(
            id="reference-at-infinity",
            call="scaled_orthographic_camera(K, inf)",
            why="The scale f/Z₀ is 0: all points would fall on one pixel.",
            returns="Refused. For a scene that is far away, f has to grow with it.",
            expected=refused("depth inf"),
            naive="np.float64(800) / np.inf * 1.0 + 320",
        ),
        HardCase(
            id="endless-depth-of-a-parallel-camera",
            call="project_affine([1.0, 2.0, 1e308], orthographic_camera(100.0))",
            why="Depths as large as numbers get.",
            returns="The exact pixel: the depth is dropped.",
            expected=valid([100.0, 200.0]),
        ),
        HardCase(
            id="infinitely-deep",
            call="project_affine([1.0, 2.0, inf], orthographic_camera(100.0))",
            why="The depth has no weight, but 0 · ∞ is not 0.",
            returns="No pixel: the point is nowhere.",
            expected=invalid,
            naive="np.float64(100) * 1.0 + 0.0 * np.inf",
        ),
        HardCase(
            id="reference-far-to-the-side",
            call="paraperspective_camera(K, [1e300, 0.0, 1e-10])",
            why="X₀/Z₀ is beyond the largest number.",
            returns="Refused: along such a line of sight everything is infinitely far off.",
            expected=refused("finite entries"),
        ),
        HardCase(
            id="perspective-as-affine",
            call="project_affine([1.0, 2.0, 4.0], P)",
            why="A perspective camera where a linear one is asked for.",
            returns="Refused: leaving its division out would give numbers without meaning.",
            expected=refused("last row"),
            naive="(P @ [1.0, 2.0, 4.0, 1.0])[:2]",
        ),
    ),
)
