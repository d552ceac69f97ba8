"""Discs smaller than a pixel or larger than the picture, and details that light cannot carry."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, exactly, near, refused
from simulations.models.lens import diffraction, disc_blur

TABLE = HardCases(
    id="blur",
    title="Blur by defocus and diffraction",
    names={
        **vars(diffraction),
        **vars(disc_blur),
        "inf": np.inf,
    },
    cases=(
        HardCase(
            id="disc-within-a-pixel",
            call="disc_kernel(0.3)",
            why="A blur disc smaller than a pixel: sampled at pixel centres it may vanish.",
            returns="A sum of 1, with R²/4 as the variance: light is kept, and so is the blur.",
            expected=lambda got: np.allclose((got.sum(), 2 * got[1, 2]), (1.0, 0.3**2 / 4)),
        ),
        HardCase(
            id="disc-infinite",
            call="disc_kernel(inf)",
            why="A kernel without end.",
            returns="Refused.",
            expected=refused("radius_px", "inf"),
        ),
        HardCase(
            id="disc-beyond-memory",
            call="disc_blur(np.ones((3, 8, 8), np.float32), 1e6)",
            why="The picture must go on beyond its edge as far as the disc reaches: terabytes.",
            returns="Refused.",
            expected=refused("radius_px", "1000000.0"),
        ),
        HardCase(
            id="finer-than-light",
            call="lens_transfer(inf, 0.55, 8.0)",
            why="arccos of a frequency beyond the cut-off is undefined.",
            returns="0: such detail does not pass.",
            expected=exactly(0.0),
            naive="2 / np.pi * (np.arccos(1.5) - 1.5 * np.sqrt(1 - 1.5**2))",
        ),
        HardCase(
            id="middle-of-the-spot",
            call="spot(0.0, 0.55, 8.0)",
            why="Airy’s (2 J₁(v)/v)² is 0/0 in the middle.",
            returns="1: an integral over the opening has no such place.",
            expected=near(1.0, 1e-12),
            naive="np.divide(2 * 0.0, 0.0) ** 2",
        ),
        HardCase(
            id="dark-middle",
            call="spot(0.0, 0.5, 4.0, 64.0)",
            why="At one wave of defocus the middle gets as much light up as down.",
            returns="0, to rounding: a bright ring around a dark point.",
            expected=near(0.0, 1e-20),
        ),
        HardCase(
            id="diffraction-of-a-pinhole",
            call="cutoff_per_mm(0.55, inf)",
            why="A hole of no width: 1/∞.",
            returns="Refused: no light comes through, and no wave.",
            expected=refused("f_number", "inf"),
            naive="1000.0 / (0.55 * np.inf)",
        ),
        HardCase(
            id="hopelessly-out-of-focus",
            call="lens_transfer(10.0, 0.55, 1.4, 1e4)",
            why="1159 waves of defocus: the integrand swings faster than it is sampled.",
            returns="Refused, rather than a number that is noise.",
            expected=refused("defocus in waves", "12"),
        ),
    ),
)
