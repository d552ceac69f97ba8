"""What an illustration is: drawings that do not move, and what they show in words."""

from dataclasses import dataclass

from simulations.engine.frame import Panel


@dataclass(frozen=True, slots=True)
class Illustration:
    """One or more drawings, and a description for readers who cannot see them."""

    panels: tuple[Panel, ...]
    """Side by side where there is room, else one below the other; SVG alone, no raster."""
    description: str
    """What they show, with their numbers: one to three sentences."""

    def __post_init__(self) -> None:
        if not self.panels:
            raise ValueError("an illustration without panels; legal: one or more")
        if any(panel.raster is not None for panel in self.panels):
            raise ValueError("an illustration with a raster; legal: SVG alone")
        if not self.description.strip():
            raise ValueError("an illustration without a description; legal: a sentence")
