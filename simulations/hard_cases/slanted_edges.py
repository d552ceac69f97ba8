"""Edges that rows meet alike, that are none, or whose light is out of every range."""

import math

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, exactly, near, refused
from simulations.models.arrays import Floats
from simulations.models.pixel_grid import centred
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge import read_edge
from simulations.models.sampling.slanted_edge_picture import edge_picture, edge_transfer


def _spot(frequency: Floats) -> Floats:
    """Of a Gaussian with a standard deviation of a pixel."""
    factor: Floats = np.exp(-2.0 * np.square(np.pi * frequency))
    return factor


def _edge(angle_deg: float, rows: int = 80, columns: int = 80) -> Floats:
    return edge_picture(rows, columns, math.radians(angle_deg), _spot)


def _mtf50(picture: Floats) -> float:
    return read_edge(picture).half_contrast().frequency


def _true(angle_deg: float) -> float:
    fine = np.linspace(0.0, 0.5, 5001)
    return first_fall(fine, _spot(fine) * edge_transfer(fine, math.radians(angle_deg)), 0.5)


def _shadowed() -> Floats:
    """A lamp from one side: the far end of the edge has half the light of the near one."""
    lamp: Floats = 1.0 + centred(80)[:, None] / 120.0
    return _edge(5.0) * lamp


def _with_dust() -> Floats:
    picture = _edge(5.0)
    picture[20:25, 35:45] = 0.0
    return picture


def _lost_pixel() -> Floats:
    picture = _edge(5.0)
    picture[3, 3] = np.nan
    return picture


def _line() -> Floats:
    picture: Floats = _edge(5.0, columns=90)[:, :80] - _edge(5.0, columns=90)[:, 10:]
    return picture


TABLE = HardCases(
    id="slanted-edges",
    title="Sharpness from an edge",
    names={
        "mtf50": _mtf50,
        "edge": _edge,
        "shadowed": _shadowed,
        "dusty": _with_dust,
        "lost_pixel": _lost_pixel,
        "line": _line,
        "nan": np.nan,
    },
    cases=(
        HardCase(
            id="upright-edge",
            call="mtf50(edge(0))",
            why="All rows meet the edge at the same place.",
            returns="Refused: one row cannot say what lies between its pixels.",
            expected=refused("too few different places"),
        ),
        HardCase(
            id="edge-at-45-degrees",
            call="mtf50(edge(45))",
            why="From row to row the edge moves by a whole pixel, which changes nothing.",
            returns="Refused, however many rows there are.",
            expected=refused("too few different places"),
        ),
        HardCase(
            id="every-second-row-alike",
            call="mtf50(edge(np.degrees(np.arctan(0.5))))",
            why="tan θ = ½: rows meet the edge at two places only; most bins of ⅛ px are empty.",
            returns="The MTF50 of the formulae: its pixels are 0.45 px apart, close enough.",
            expected=near(_true(math.degrees(math.atan(0.5))), 1e-3),
        ),
        HardCase(
            id="one-pixel",
            call="mtf50(edge(5, 1, 1))",
            why="A picture of one pixel.",
            returns="Refused.",
            expected=refused("too small"),
        ),
        HardCase(
            id="edge-without-contrast",
            call="mtf50(0 * edge(5) + 0.5)",
            why="Dark and light are equal, and shares of their difference are 0/0.",
            returns="Refused.",
            expected=refused("Too little contrast"),
            naive="np.divide(0.5 - 0.5, 0.5 - 0.5)",
        ),
        HardCase(
            id="lost-pixel",
            call="mtf50(lost_pixel())",
            why="One pixel is NaN, and so is every sum with it.",
            returns="Refused.",
            expected=refused("finite"),
        ),
        HardCase(
            id="very-bright-edge",
            call="mtf50(1e300 * edge(5))",
            why="The squares by which the direction of the edge is found overflow.",
            returns="As for any light: only ratios count.",
            expected=near(_true(5.0), 1e-3),
            naive="np.square(1e300)",
        ),
        HardCase(
            id="dim-edge",
            call="mtf50(1e-300 * edge(5))",
            why="The same squares vanish.",
            returns="As for any light.",
            expected=near(_true(5.0), 1e-3),
            naive="np.square(1e-300)",
        ),
        HardCase(
            id="shadowed-edge",
            call="mtf50(shadowed())",
            why="No level lies half-way between dark and light in every row.",
            returns="The MTF50 of the formulae: each row has levels of its own.",
            expected=near(_true(5.0), 2e-3),
        ),
        HardCase(
            id="dust-on-the-edge",
            call="mtf50(dusty())",
            why="A black speck pulls the line to itself.",
            returns="The MTF50 of the formulae: rows far off the line are left out.",
            expected=near(_true(5.0), 2e-3),
        ),
        HardCase(
            id="line-in-place-of-an-edge",
            call="mtf50(line())",
            why="It is dark on both sides: there is no step to take shares of.",
            returns="Refused.",
            expected=refused("No straight edge"),
        ),
        HardCase(
            id="lying-edge",
            call="mtf50(edge(5).T) == mtf50(edge(5))",
            why="No row crosses from dark to light.",
            returns="True: the picture is turned first.",
            expected=exactly(True),
        ),
    ),
)
