"""Spectra of colour-science, on the book's grid of wavelengths."""

import warnings
from typing import Any

import numpy as np

from simulations.models.arrays import Floats

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it misses packages for plotting
    import colour

oracle: Any = colour


def sampled(distribution: Any) -> Floats:
    """A spectrum of the library every 5 nm from 380 to 780."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it tells that it interpolates
        return np.asarray(distribution.copy().align(oracle.SpectralShape(380, 780, 5)).values)


def illuminant(name: str) -> Floats:
    """An illuminant of the CIE."""
    return sampled(oracle.SDS_ILLUMINANTS[name])


TABULATED = sampled(oracle.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"])
"""(81, 3) the CIE's own tables of x̄, ȳ, z̄."""


def tabulated_xy(light: Floats) -> Floats:
    """Chromaticity of a light (81,) by these tables."""
    xyz = light @ TABULATED
    pair: Floats = xyz[:2] / xyz.sum()
    return pair
