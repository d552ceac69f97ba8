"""Rays that no lens of glass lets through, and surfaces that are flat or nearly so."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, exactly, near, refused
from simulations.models.lens import singlet, stop_position

TABLE = HardCases(
    id="singlet",
    title="A lens of glass",
    names={
        **vars(singlet),
        **vars(stop_position),
        "inf": np.inf,
    },
    cases=(
        HardCase(
            id="beyond-the-critical-angle",
            call="through_exact(Singlet(0.0, -0.04, 12.0, 1.5), inf, [17.0], 22.0).crossing_mm",
            why="Snell’s law asks for an angle whose sine is 1.02.",
            returns="No crossing; the ray’s fate says that it was totally reflected.",
            expected=exactly([np.nan]),
            naive="np.arcsin(1.5 * 17.0 / 25.0)",
        ),
        HardCase(
            id="past-the-sphere",
            call="through_exact(Singlet(0.04, 0.0, 12.0, 1.5), inf, [30.0], 40.0).fate",
            why="A ray at 30 mm never meets a sphere of 25 mm: a root of a negative number.",
            returns="1, which says that it misses the glass.",
            expected=exactly([singlet.MISSES]),
            naive="25.0 - np.sqrt(25.0**2 - 30.0**2)",
        ),
        HardCase(
            id="flat-surface",
            call="sag_mm(0.0, 10.0)",
            why="A plane is a sphere of infinite radius: R − √(R² − h²) is ∞ − ∞.",
            returns="0: written in the curvature, it has no special case.",
            expected=exactly(0.0),
            naive="np.inf - np.sqrt(np.float64(np.inf) - 100.0)",
        ),
        HardCase(
            id="nearly-flat-surface",
            call="sag_mm(1e-12, 1.0)",
            why="R and √(R² − h²) agree in all digits.",
            returns="5e-13: nothing is subtracted.",
            expected=near(5e-13, 1e-15),
            naive="1e12 - np.sqrt(1e12**2 - 1.0)",
        ),
        HardCase(
            id="pane-of-glass",
            call="focal_mm(power_per_mm(Singlet(0.0, 0.0, 5.0, 1.5)))",
            why="1/0.",
            returns="∞: a pane gathers no light.",
            expected=exactly(np.inf),
        ),
        HardCase(
            id="crossed-surfaces",
            call="rim_mm(Singlet(0.04, -0.04, 2.0, 1.5), 22.0)",
            why="Two strong bulges on a thin lens meet before its rim.",
            returns="√(25² − 24²) = 7 mm: there the glass ends.",
            expected=near(7.0, 1e-12),
        ),
        HardCase(
            id="stop-inside-the-glass",
            call="chief_rays(Singlet(0.02, -0.02, 6.0, 1.5), 1.0, [0.1])",
            why="The aperture stop stands between the two faces of the lens.",
            returns="Refused: a ray cannot start in the glass.",
            expected=refused("stop_mm", "outside the glass"),
        ),
    ),
)
