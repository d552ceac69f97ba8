"""Three paths of a camera from straight ahead to the set orientation.

The line of sight leaves a trace on a sphere. Along a slerp that is an arc of a circle about one
fixed axis; blended Euler angles wander; blended matrices cut through the sphere.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.drawing import circle, dot, line, path, text
from simulations.engine.space.view import runs
from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.quaternion_blends import Blend
from simulations.models.geometry.rotation_paths import euler_blend, matrix_blend
from simulations.scenes._turned_camera import body

WIDTH, HEIGHT = 400.0, 400.0
CENTRE, RADIUS = (200.0, 212.0), 150.0
STEPS = 60
MARK_EVERY = 6
"""Steps between marks on the quaternions' path: even marks show a constant speed."""
START = np.array([1.0, 0.0, 0.0, 0.0])

ROLES = {"slerp": "ray", "euler": "error", "matrix": "image"}
LABELS = {"slerp": "quaternion slerp", "euler": "Euler angles", "matrix": "matrix entries"}
MANNERS = {"slerp": "bold", "euler": "dashed", "matrix": "thin"}

type Path = Callable[[ArrayLike], Floats]


def paths(angles_rad: Sequence[float], C: Floats, q: Floats, blend: Blend) -> dict[str, Path]:
    """From shares (...), 0 straight ahead and 1 at the end, to matrices (..., 3, 3).

    ``blend`` is one of `quaternion_blends.BLENDS`.
    """
    return {
        "slerp": lambda share: quaternions.to_matrix(blend(START, q, share)),
        "euler": lambda share: euler_blend("YXZ", (0.0, 0.0, 0.0), angles_rad, share),
        "matrix": lambda share: matrix_blend(np.eye(3), C, share),
    }


def traces_of(all_paths: Mapping[str, Path], view: Floats) -> dict[str, Floats]:
    """The places (n, 3) of the line of sight along each path: view box x, y, and depth."""
    shares = np.linspace(0.0, 1.0, STEPS + 1)
    return {
        name: on_screen(rotations(shares)[:, :, 2], view) for name, rotations in all_paths.items()
    }


def draw(
    all_paths: Mapping[str, Path],
    traces: Mapping[str, Floats],
    view: Floats,
    chosen: str,
    share: float,
) -> str:
    """SVG markup of the panel: the traces, and the camera on the chosen path."""
    blends = {name: rotations(share) for name, rotations in all_paths.items()}
    beads = [
        dot(on_screen(blend[:, 2], view), ROLES[name], 6.0 if name == chosen else 3.5)
        for name, blend in blends.items()
    ]
    return "".join(
        (
            *_globe(view),
            *(_trace(traces[name], name, front=False) for name in traces),
            *_camera(blends[chosen], view, chosen),
            *(_trace(traces[name], name, front=True) for name in traces),
            *_marks(traces["slerp"]),
            *_ends(traces["slerp"]),
            *beads,
            *_legend(chosen),
        )
    )


def _camera(blend: Floats, view: Floats, chosen: str) -> tuple[str, str]:
    """The camera at the centre, with its line of sight to the sphere, back to front."""
    inner, end = on_screen(np.stack([0.45 * blend[:, 2], blend[:, 2]]), view)
    sight = line(inner, end, f"{ROLES[chosen]} thin")
    camera = body.draw(blend, view, CENTRE, 0.52 * RADIUS)
    return (sight, camera) if end[2] > 0 else (camera, sight)


def _globe(view: Floats) -> Iterator[str]:
    """Outline, horizon and two meridians; only the near half of each."""
    yield circle(CENTRE, RADIUS, "muted thin")
    turns = np.linspace(0, 2 * math.pi, 73)
    flat = np.zeros_like(turns)
    around = (np.cos(turns), np.sin(turns))
    rings = (
        np.stack([around[0], flat, around[1]], axis=-1),
        np.stack([*around, flat], axis=-1),
        np.stack([flat, *around], axis=-1),
    )
    halves = [run for ring in rings for run in runs(on_screen(ring, view), front=True)]
    yield path(halves, "muted thin faint")


def _trace(points: Floats, name: str, *, front: bool) -> str:
    style = f"{ROLES[name]} {MANNERS[name]}" + ("" if front else " faint")
    return path(runs(points, front=front), style)


def _marks(trace: Floats) -> Iterator[str]:
    for place in trace[MARK_EVERY:-1:MARK_EVERY]:
        far = place[2] > 0
        yield dot(place, ROLES["slerp"] + (" faint" if far else ""), 3.4)


def _ends(trace: Floats) -> Iterator[str]:
    """Start and end, the upper one with its name above it and the lower one with it below."""
    start, end = trace[0], trace[-1]
    for point, label, other in ((start, "start", end), (end, "end", start)):
        yield circle(point, 5.5, "camera")
        row = point[1] + (-11.0 if point[1] <= other[1] else 21.0)
        yield text((point[0], row), label, "camera small ground", "middle")


def _legend(chosen: str) -> Iterator[str]:
    for row, (name, label) in enumerate(LABELS.items()):
        y = 22.0 + 18.0 * row
        yield line((14, y - 4.5), (40, y - 4.5), f"{ROLES[name]} {MANNERS[name]}")
        weight = " strong" if name == chosen else ""
        yield text((48, y), label, f"{ROLES[name]} ground{weight}")


def on_screen(points: Floats, view: Floats) -> Floats:
    """World points (..., 3) in the panel: view box x, y, and depth."""
    return body.screen(points, view, CENTRE, RADIUS)
