"""An illustration: static drawings with a description."""

from dataclasses import dataclass

from simulations.engine.frame import Panel as Panel


@dataclass(frozen=True, slots=True)
class Illustration:
    """One or more drawings, and a description for readers who cannot see them."""

    panels: tuple[Panel, ...]
    """SVG only, without rasters; side by side if there is space, else stacked."""
    description: str
    """One to three sentences on what the drawings show, with the numbers."""

    def __post_init__(self) -> None:
        if not self.panels:
            raise ValueError("an illustration without panels; legal: one or more")
        if any(panel.raster is not None for panel in self.panels):
            raise ValueError("an illustration with a raster; legal: SVG alone")
        if not self.description.strip():
            raise ValueError("an illustration without a description; legal: a sentence")
