"""The labels of an axis: its name, unit and ticks."""

from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass
from functools import partial

from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.ticks import Tick, number_words


@dataclass(frozen=True, slots=True)
class Scale:
    """The labels of one axis."""

    name: str = ""
    unit: str = ""
    ticks: int | Sequence[float] | Sequence[Tick] = 5
    """The largest count of round ticks; or the ticks; or the ticks, each with its text, which may
    be empty."""
    _: KW_ONLY
    grid: Sequence[float] = ()
    """Values with a grid line."""
    style: str = ""
    """CSS classes of the name."""
    tick_style: str = "muted"
    centred: bool = False
    """Whether the name of the x axis is below its middle, not below its end."""
    gap: float = 0.0
    """Extra space between the edge of the plot and the ticks."""

    @property
    def title(self) -> str:
        return f"{self.name}, {self.unit}" if self.unit else self.name

    def ticks_on(self, axis: Axis) -> Iterable[tuple[float, str]]:
        """View box coordinates of the ticks, and their texts."""
        ticks = axis.ticks(self.ticks) if isinstance(self.ticks, int) else self.ticks
        for tick in ticks:
            value, words = tick if isinstance(tick, tuple) else (tick, number_words(tick))
            yield axis.place(value), words


small_scale = partial(Scale, style="small", tick_style="muted small")
"""A scale in small letters."""
