"""An illustration: static drawings with a description, shown at once or in steps.

`drafting.picture` puts pixels into a drawing. Marks that appear in steps go through `in_steps`, and
a numbered list at the end of the caption has a sentence for each step.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from simulations.engine.drawing import group
from simulations.engine.frame import Panel as Panel

LATER = re.compile(r'class="step-(\d+)"')


def in_steps(first: Iterable[str], *later: Iterable[str]) -> str:
    """Marks that appear one part after the other, when the reader presses a button."""
    parts = (group(marks, f"step-{step}") for step, marks in enumerate(later, start=2))
    return "".join([*first, *parts])


@dataclass(frozen=True, slots=True)
class Illustration:
    """One or more drawings, and a description for readers who cannot see them."""

    panels: tuple[Panel, ...]
    """SVG only, without rasters; side by side if there is space, else stacked."""
    description: str
    """One to three sentences on what the drawings show, with the numbers."""

    @property
    def steps(self) -> int:
        """Count of steps of the drawings; 1 if all appears at once."""
        found = (LATER.findall(panel.overlay) for panel in self.panels)
        return max([1, *(int(step) for steps in found for step in steps)])

    def __post_init__(self) -> None:
        if not self.panels:
            raise ValueError("an illustration without panels; legal: one or more")
        if any(panel.raster is not None for panel in self.panels):
            raise ValueError("an illustration with a raster; legal: SVG alone")
        if not self.description.strip():
            raise ValueError("an illustration without a description; legal: a sentence")
