"""The plot: how far each way has turned the camera, by the progress along it."""

from collections.abc import Mapping

import numpy as np

from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.scenes.rotation_3d.sphere import MANNERS, ROLES, STEPS, Path

WIDTH, HEIGHT = 400.0, 340.0
PLOT = Plot(Axis(0.0, 1.0, 52.0, 384.0), Axis(0.0, 180.0, 290.0, 36.0))
SCALES = (
    Scale("progress s", ticks=(0.0, 0.5, 1.0)),
    Scale("turned so far, °", ticks=(0.0, 60.0, 120.0)),
)


def turned_deg(matrices: Floats) -> Floats:
    """Angles (...) of matrices (..., 3, 3): of a rotation its own, of a blend of entries that of
    the nearest rotation about the same axis."""
    skew = matrices - np.swapaxes(matrices, -1, -2)
    sine = np.hypot(np.hypot(skew[..., 2, 1], skew[..., 0, 2]), skew[..., 1, 0]) / 2.0
    cosine = (np.trace(matrices, axis1=-2, axis2=-1) - 1.0) / 2.0
    return np.degrees(np.arctan2(sine, cosine))


def curves_of(all_paths: Mapping[str, Path]) -> dict[str, Floats]:
    """The angle (n,) turned along each path."""
    shares = np.linspace(0.0, 1.0, STEPS + 1)
    return {name: turned_deg(rotations(shares)) for name, rotations in all_paths.items()}


def mark(all_paths: Mapping[str, Path], chosen: str, share: float) -> tuple[float, float]:
    """The place of the progress on the chosen curve."""
    return PLOT.at(share, float(turned_deg(all_paths[chosen](share))))


def draw(
    all_paths: Mapping[str, Path], curves: Mapping[str, Floats], chosen: str, share: float
) -> str:
    """SVG markup of the panel."""
    shares = np.linspace(0.0, 1.0, STEPS + 1)
    here = float(turned_deg(all_paths[chosen](share)))
    lines = [
        PLOT.curve(shares, curve, f"{ROLES[name]} {MANNERS[name]}")
        for name, curve in curves.items()
    ]
    return "".join(
        (PLOT.frame(*SCALES), PLOT.drop(share, here), *lines, PLOT.mark(share, here, ROLES[chosen]))
    )


def progress_at(x: float) -> float:
    """The progress at a column of the panel, clamped to the axis."""
    return min(max(PLOT.x.value(x), 0.0), 1.0)
