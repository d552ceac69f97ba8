"""The stages of the figure of a light on a cloth: light × surface, and what the eye sees of it."""

from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.chromatic_adaptation import adapt
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.cie import D65_XY, xyz_to_lab, xyz_to_linear_rgb
from simulations.models.color.observer import tristimulus
from simulations.scenes._spectra.patches import Chart
from simulations.scenes._spectra.spectra import DAYLIGHT, light_of, surfaces_of, with_twins

ROWS = (("in this light", "world"), ("by day", "world"))
CHART = Chart(ROWS, 128, gap=0)
"""The rows touch, so that the edge between two patches is their difference."""
TWINS_CHART = Chart(ROWS, 120)
"""With a twin below each surface, whose difference is then that edge."""


def chart(twin: bool) -> Chart:
    """The layout with or without the twins."""
    return TWINS_CHART if twin else CHART


@dataclass(frozen=True, slots=True)
class Seen:
    """Twelve surfaces to the eye, and their twins in a second row: (2, 12, 3) each."""

    xyz: Floats
    """XYZ in this light; white has Y = 1."""
    white_xy: tuple[float, float]
    """Chromaticity of the light itself."""
    here: Floats
    """Linear sRGB seen by an eye that is adapted to this light."""
    by_day: Floats
    """Linear sRGB seen in daylight."""
    apart: Floats
    """(12,) ΔE of the twins in this light."""


def _seen(light: Floats, pairs: Floats) -> Seen:
    xyz = tristimulus(pairs * light, light)
    x, y = xyz_to_xyy(tristimulus(light, light))[:2].tolist()
    original, twin = xyz_to_lab(xyz, (x, y))
    return Seen(
        xyz=xyz,
        white_xy=(x, y),
        here=xyz_to_linear_rgb(adapt(xyz, (x, y), D65_XY)),
        by_day=xyz_to_linear_rgb(tristimulus(pairs * DAYLIGHT, DAYLIGHT)),
        apart=lab_distance(original, twin),
    )


def _picture(seen: Seen, twin: bool) -> Raster:
    """The patches; twins in the lower halves."""
    return chart(twin).paint((seen.here, seen.by_day), twin=twin)


def outside(linear: np.ndarray) -> bool:
    """Whether a colour (3,) lies outside the gamut of sRGB."""
    return bool((np.abs(linear - 0.5) > 0.5).any())


STAGES = (
    Stage("light", light_of),
    Stage("surfaces", surfaces_of),
    Stage("pairs", with_twins, ("surfaces",)),
    Stage("seen", _seen, ("light", "pairs")),
    Stage("picture", _picture, ("seen",)),
)
