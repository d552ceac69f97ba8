"""The contract between a widget and everything that shows it."""

from collections.abc import Callable
from dataclasses import dataclass

from simulations.engine.controls import Control, Slider, Values
from simulations.engine.frame import Frame
from simulations.engine.pipeline import StageCache

type Render = Callable[[Values, str, StageCache], Frame]


@dataclass(frozen=True, slots=True)
class Scene:
    """A widget: what the reader may change, and what each choice looks like."""

    id: str
    title: str
    controls: tuple[Control, ...]
    render: Render
    """Pure: no clock, no globals, no unseeded randomness. Takes values, tier ('' where the scene
    has none) and the figure's stage cache, which changes how long it takes, never the result."""
    tiers: tuple[str, ...] = ()
    """Accuracy choices, cheap to dear."""
    default_tier: str = ""
    """The tier a figure settles in."""
    draft_tier: str = ""
    """The tier a figure uses while a control is being dragged."""

    def __post_init__(self) -> None:
        names = [control.name for control in self.controls]
        if len(set(names)) != len(names):
            raise ValueError(f"scene {self.id!r}: duplicate control in {names}")
        sliders = {control.name for control in self.controls if isinstance(control, Slider)}
        for control in self.controls:
            driven = getattr(control, "drives", "")
            if driven and driven not in sliders:
                raise ValueError(f"scene {self.id!r}: {control.name!r} drives no slider {driven!r}")
        for tier in (self.default_tier, self.draft_tier):
            if tier not in (*self.tiers, "") or bool(self.tiers) != bool(tier):
                raise ValueError(f"scene {self.id!r}: tier {tier!r}; legal: {self.tiers}")
