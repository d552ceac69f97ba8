"""Which control of a figure shows most of it."""

from simulations.engine.controls import Action, Choice, Control, Slider, Toggle
from site_builder.document.blocks import Simulation


def main_control(figure: Simulation) -> Control | None:
    """The first whose values can be shown side by side. A menu that chooses a picture shows
    less than a slider."""
    controls = figure.scene.controls
    ordered = [*(c for c in controls if isinstance(c, Slider)), *controls]
    if controls and isinstance(controls[0], Choice):
        ordered.insert(0, controls[0])
    return next((c for c in ordered if not isinstance(c, Action | Toggle)), None)
