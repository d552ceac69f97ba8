"""Spectra of colour-science, on the book's grid of wavelengths."""

import warnings
from typing import Any

import numpy as np

from simulations.models.arrays import Floats

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # of missing packages for plotting
    import colour

oracle: Any = colour


def on_grid(distribution: Any) -> Floats:
    """A spectrum (81,) of the library, every 5 nm from 380 to 780."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of interpolation
        return np.asarray(distribution.copy().align(oracle.SpectralShape(380, 780, 5)).values)


def illuminant(name: str) -> Floats:
    """The spectrum (81,) of a CIE illuminant."""
    return on_grid(oracle.SDS_ILLUMINANTS[name])


TABULATED = on_grid(oracle.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"])
"""The tables of x̄, ȳ, z̄ by the CIE, (81, 3)."""


def tabulated_xy(light: Floats) -> Floats:
    """The chromaticity (2,) of a light (81,) by these tables."""
    xyz = light @ TABULATED
    pair: Floats = xyz[:2] / xyz.sum()
    return pair
