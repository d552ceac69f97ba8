"""The stages of the slanted edge: a picture, and the MTF measured from it."""

import math

import numpy as np

from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import lens_transfer
from simulations.models.sampling.slanted_edge import (
    EdgeReading,
    edge_picture,
    edge_transfer,
    read_edge,
)

ROWS, COLUMNS = 45, 60
WAVELENGTH_UM = 0.55
FREQUENCIES = np.linspace(0.0, 1.0, 51)
"""Cycles per pixel, up to twice the Nyquist frequency."""


def lens_factor(frequency: Floats, aperture: float, pitch: float) -> Floats:
    """Factor (...) of the lens on waves (...) in cycles per pixel."""
    return lens_transfer(1000.0 / pitch * frequency, WAVELENGTH_UM, aperture)


def _picture(angle: float, aperture: float, pitch: float) -> Floats:
    """(45, 60) light in each pixel."""
    return edge_picture(
        ROWS, COLUMNS, math.radians(angle), lambda f: lens_factor(f, aperture, pitch)
    )


def _reading(picture: Floats) -> EdgeReading:
    return read_edge(picture)


def _measured(reading: EdgeReading) -> Floats:
    """(51,) measured MTF; NaN where it is undetermined."""
    return reading.transfer(FREQUENCIES)


def _true(angle: float, aperture: float, pitch: float) -> Floats:
    """(51,) MTF by the formulae of lens and pixel."""
    pixel = edge_transfer(FREQUENCIES, math.radians(angle))
    return np.abs(lens_factor(FREQUENCIES, aperture, pitch) * pixel)


STAGES = (
    Stage("picture", _picture),
    Stage("reading", _reading, ("picture",)),
    Stage("measured", _measured, ("reading",)),
    Stage("true", _true),
)
