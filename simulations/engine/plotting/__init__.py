"""Plots: axes with ticks, curves and areas, legends, and labels placed without overlap."""

from simulations.engine.plotting.axis import Axis as Axis
from simulations.engine.plotting.plot import Plot as Plot
from simulations.engine.plotting.scale import Scale as Scale
