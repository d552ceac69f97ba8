"""Figures in Jupyter notebooks: a scene with the widgets of its controls."""
