"""Accuracy: the levels at which a scene can be computed, from cheap to accurate.

A scene lists its levels, never which slider needs which: while something moves, the page takes
the most accurate level that this device computes in time (`static/js/figure/chooser.ts`).
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from simulations.engine.controls import Value
from simulations.engine.frame import Readout
from simulations.engine.stages import Outputs

WITHIN: Mapping[str, Mapping[str, float]] = {
    "codes": {"within-half-code": 0.5, "within-code": 1.0},
    "px": {"within-tenth-pixel": 0.1},
}
"""Errors that a reader may allow, by unit and name."""


@dataclass(frozen=True, slots=True)
class Level:
    """One way to compute a scene."""

    name: str
    """Its id, in addresses and chapters."""
    label: str = ""
    """Label for readers; a tier of the scene's ladder needs none."""
    stage_values: Mapping[str, Value] = field(default_factory=dict)
    """Parameters of the stages. ``tier`` is the level's name, unless it is among them."""

    @property
    def parameters(self) -> dict[str, Value]:
        """All parameters of the stages at this level."""
        return {"tier": self.name, **self.stage_values}


def tiers(*names: str, labels: Mapping[str, str] | None = None) -> tuple[Level, ...]:
    """Levels whose parameter ``tier`` is their name. ``labels`` are for levels that are in no
    ladder, or whose label there does not fit."""
    return tuple(Level(name, (labels or {}).get(name, "")) for name in names)


def columns(*counts: int, label: str = "{} columns") -> tuple[Level, ...]:
    """Levels of resolution: each gives the stages a number of ``columns`` of pixels."""
    return tuple(Level(str(count), label.format(count), {"columns": count}) for count in counts)


@dataclass(frozen=True, slots=True, kw_only=True)
class Accuracy[S]:
    """The levels of a scene whose settings are ``S``."""

    levels: tuple[Level, ...] = ()
    """From cheap to accurate."""
    default: str = ""
    """The level at rest; if empty, the last."""
    ladder: str = ""
    """The ladder whose tiers are among the levels; it has their labels and costs. In a scene
    without levels, one of the controls chooses between the tiers."""
    estimate: Callable[[S, Outputs, str], Iterator[Readout]] | None = None
    """Yields better and better estimates of the error of a frame in a tier, with a unit. Called
    while nothing moves; each step must be short."""
    unit: str = ""
    """Unit of the estimates, if readers may choose the cheapest level within an error: one of
    `WITHIN`."""

    def __post_init__(self) -> None:
        if self.levels and not self.default:
            object.__setattr__(self, "default", self.levels[-1].name)

    @property
    def within(self) -> Mapping[str, float]:
        """Errors within which readers may have the cheapest level, by name."""
        return WITHIN.get(self.unit, {})

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the levels."""
        return tuple(level.name for level in self.levels)

    @property
    def cheapest(self) -> str:
        """Name of the cheapest level; empty where there is one way to compute the scene."""
        return next(iter(self.names), "")

    def level(self, name: str) -> Level:
        """The level of that name, or the default."""
        by_name: dict[str, Level] = {level.name: level for level in self.levels}
        return by_name.get(name) or by_name.get(self.default) or Level("")

    def mistakes(self) -> Iterator[str]:
        """Messages about contradictions."""
        names = self.names
        if len(set(names)) != len(names):
            yield f"levels {names}; legal: a name for each"
        if self.default not in (*names, ""):
            yield f"default level {self.default!r}; legal: {names}"
        if self.unit and not (self.unit in WITHIN and self.estimate and self.levels):
            yield f"unit {self.unit!r}; legal: {', '.join(WITHIN)}, with levels and an estimate"
        for level in self.levels:
            if not self.ladder and not level.label:
                yield f"level {level.name!r} has no label, and no ladder that has one"


ONE_LEVEL: Accuracy[Any] = Accuracy()
"""For a scene with one way to compute it."""
