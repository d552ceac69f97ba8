"""The contract between a widget and everything that shows it."""

import itertools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from simulations.engine.controls import Control, Slider, Values
from simulations.engine.frame import Frame, Readout
from simulations.engine.pipeline import StageCache

type Render = Callable[[Values, str, StageCache], Frame]
type Judge = Callable[[Values, str, StageCache], Iterator[Readout]]


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
    """The tier a figure uses while a control is being dragged, unless a cheaper one is chosen."""
    drafted: tuple[str, ...] = ()
    """The controls whose drags need the draft; all of them where none is named."""
    drafted_in: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """Further controls by tier, where a dear one must redo what the default keeps at hand."""
    ladder: str = ""
    """The ladder that the tiers are rungs of: it labels them and tells what they cost. Without
    tiers, a control of the scene's own chooses between its rungs."""
    tier_labels: Mapping[str, str] = field(default_factory=dict)
    """What the reader sees of tiers that belong to no ladder, or that its words do not fit here."""
    error: Judge | None = None
    """How far a frame in this tier is from the truth, with a unit. Asked only while nothing
    moves, one step at a time: each step is short and yields a better estimate than the last."""

    def __post_init__(self) -> None:
        names = [control.name for control in self.controls]
        if len(set(names)) != len(names):
            raise ValueError(f"scene {self.id!r}: duplicate control in {names}")
        sliders = {control.name for control in self.controls if isinstance(control, Slider)}
        for control in self.controls:
            driven = getattr(control, "drives", "")
            if driven and driven not in sliders:
                raise ValueError(
                    f"scene {self.id!r}: {control.name!r} drives no slider {driven!r}; "
                    f"legal: {', '.join(sliders) or 'none'}"
                )
        for tier in (self.default_tier, self.draft_tier):
            if tier not in (*self.tiers, "") or bool(self.tiers) != bool(tier):
                raise ValueError(f"scene {self.id!r}: tier {tier!r}; legal: {self.tiers}")
        if not set(self.drafted_in) <= set(self.tiers):
            raise ValueError(
                f"scene {self.id!r}: drafted_in {self.drafted_in}; legal: {self.tiers}"
            )
        for name in itertools.chain(self.drafted, *self.drafted_in.values()):
            if name not in names:
                raise ValueError(f"scene {self.id!r}: drafted {name!r}; legal: {names}")
        labelled = set(self.tier_labels)
        if not labelled <= set(self.tiers):
            raise ValueError(f"scene {self.id!r}: labels {labelled}; legal: {self.tiers}")
        if self.tiers and not self.ladder and labelled != set(self.tiers):
            raise ValueError(f"scene {self.id!r}: tiers {self.tiers} have no ladder to label them")
