"""The controls of a figure as their template needs them: texts, and where each one stands."""

from collections.abc import Sequence
from dataclasses import dataclass

from simulations.engine.controls import Action, Choice, Control, Slider, Value
from simulations.engine.frame import format_number
from site_builder.benchmarks.quantities import with_unit
from site_builder.figures.initial_frames import InitialFrame
from site_builder.languages.words import ENGLISH, Words
from site_builder.pages.figure_grid import (
    FOLDED,
    IN_A_ROW,
    cells_in_sight,
    gather_buttons,
    spans,
)

LONG_OPTION = 13
"""Characters of an option, above which its menu would be cut in half the width of a phone."""


@dataclass(frozen=True, slots=True)
class ControlView:
    """A control and its starting state."""

    control: Control
    id: str
    value: Value
    text: str
    """A slider's value with its unit; a button's present label."""
    longest: str
    """The longest that a slider's text can be: its room is kept, so that nothing moves."""


@dataclass(frozen=True, slots=True)
class CellView:
    """What stands in one cell of the grid of controls."""

    controls: tuple[ControlView, ...]
    """One, or buttons in a run; none in the cell of the accuracy."""
    spans: str
    """Columns that it takes, by the room that there is, as CSS variables."""


def control_cells(
    still: InitialFrame, tiers: Sequence[tuple[str, str]], words: Words = ENGLISH
) -> tuple[tuple[CellView, ...], tuple[CellView, ...]]:
    """The cells always in sight, and those that are folded where space is narrow.

    The last of all is the accuracy's, where there is a choice of it.
    """
    cells = [*gather_buttons(still.figure.scene.controls), *([()] if tiers else [])]
    lengths = [max(map(len, _options(cell, tiers)), default=0) for cell in cells]
    # Three buttons need the room of two other controls; on a phone long words do, too.
    places = [2 if len(cell) > 2 else 1 for cell in cells]
    on_phones = [
        2 if length > LONG_OPTION else place for length, place in zip(lengths, places, strict=True)
    ]
    kept = cells_in_sight(on_phones, IN_A_ROW["narrow"])

    def taken(room: str) -> list[int]:
        most, given = IN_A_ROW[room], on_phones if room == "narrow" else places
        if room in FOLDED:
            return [*spans(given[:kept], most), *spans(given[kept:], most)]
        return spans(given, most)

    by_room = zip(*(taken(room) for room in IN_A_ROW), strict=True)
    views = tuple(
        CellView(
            tuple(_control(still, control, words) for control in cell),
            "; ".join(f"--{room}: {span}" for room, span in zip(IN_A_ROW, row, strict=True)),
        )
        for cell, row in zip(cells, by_room, strict=True)
    )
    return views[:kept], views[kept:]


def _options(cell: tuple[Control, ...], tiers: Sequence[tuple[str, str]]) -> list[str]:
    """What a menu shows, one line at a time; nothing for other controls."""
    if not cell:
        return [label for _, label in tiers]
    return list(cell[0].options.values()) if isinstance(cell[0], Choice) else []


def _control(still: InitialFrame, control: Control, words: Words) -> ControlView:
    value = still.values[control.name]
    text = value_text(control, value, words)
    ends = (control.minimum, control.maximum) if isinstance(control, Slider) else ()
    longest = max((text, *(value_text(control, end, words) for end in ends)), key=len)
    return ControlView(control, f"{still.figure.id}-{control.name}", value, text, longest)


def value_text(control: Control, value: Value, words: Words = ENGLISH) -> str:
    """The value as ``controls.js`` writes it: ``f/2.8``, ``5.0 m``, ``30°``."""
    match control:
        case Slider():
            number = words.numeral(format_number(float(value), control.decimals))
            return with_unit(f"{control.prefix}{number}", control.unit)
        case Action():
            return control.labels[int(value)]
        case Choice():
            return control.options[str(value)]
        case _:
            return ""
