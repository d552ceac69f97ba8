"""Plots: axes with ticks, curves and areas, legends, and labels placed without overlap."""
