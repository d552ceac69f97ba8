"""Plots: axes with their ticks, curves and areas between them, legends, labels in free places."""
