"""What is written along an axis: its name, its unit, its ticks."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.ticks import Tick, number_words


@dataclass(frozen=True, slots=True)
class Scale:
    """The words of one axis."""

    name: str = ""
    unit: str = ""
    ticks: int | Sequence[float] | Sequence[Tick] = 6
    """At most so many round numbers; or these; or these, each with its words, which may be none."""
    grid: Sequence[float] = ()
    """Values with a faint line through the plot."""
    style: str = ""
    """Of the name."""
    tick_style: str = "muted"
    centred: bool = False
    """The name of the x axis stands below its middle, not below its end."""
    gap: float = 0.0
    """Between the edge of the plot and the ticks, for what else stands there."""

    @property
    def title(self) -> str:
        return f"{self.name}, {self.unit}" if self.unit else self.name

    def ticks_on(self, axis: Axis) -> Iterable[tuple[float, str]]:
        """View box coordinates of the ticks, and their words."""
        ticks = axis.ticks(self.ticks) if isinstance(self.ticks, int) else self.ticks
        for tick in ticks:
            value, words = tick if isinstance(tick, tuple) else (tick, number_words(tick))
            yield axis.place(value), words
