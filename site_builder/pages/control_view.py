"""The controls of a figure as their template needs them: texts, and where each one stands."""

from collections.abc import Sequence
from dataclasses import dataclass

from simulations.engine.controls import Action, Choice, Control, Slider, Value
from simulations.engine.frame import format_number
from site_builder.measured.quantities import with_unit
from site_builder.pages.figure_grid import IN_A_ROW, cells_in_sight, gather_buttons, spans
from site_builder.pages.stills import Still

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
    still: Still, tiers: Sequence[tuple[str, str]]
) -> tuple[tuple[CellView, ...], tuple[CellView, ...]]:
    """The cells always in sight, and those that are folded where space is narrow.

    The last of all is the accuracy's, where there is a choice of it.
    """
    cells = [*gather_buttons(still.figure.scene.controls), *([()] if tiers else [])]
    on_phones = [_places(cell, tiers) for cell in cells]
    kept = cells_in_sight(on_phones, IN_A_ROW["narrow"])
    return (
        _placed(still, cells[:kept], on_phones[:kept]),
        _placed(still, cells[kept:], on_phones[kept:]),
    )


def _places(cell: tuple[Control, ...], tiers: Sequence[tuple[str, str]]) -> int:
    """How many controls' room a cell takes on a phone: two where it shows long words."""
    if not cell:
        options = [label for _, label in tiers]
    elif isinstance(cell[0], Choice):
        options = list(cell[0].options.values())
    else:
        return _buttons_places(cell)
    return 2 if max(map(len, options)) > LONG_OPTION else 1


def _buttons_places(cell: tuple[Control, ...]) -> int:
    """Three buttons need the room of two other controls, wherever they are."""
    return 2 if len(cell) > 2 else 1


def _placed(
    still: Still, cells: Sequence[tuple[Control, ...]], on_phones: Sequence[int]
) -> tuple[CellView, ...]:
    elsewhere = [_buttons_places(cell) for cell in cells]
    by_room = zip(
        *(
            spans(on_phones if room == "narrow" else elsewhere, most)
            for room, most in IN_A_ROW.items()
        ),
        strict=True,
    )
    return tuple(
        CellView(
            tuple(_control(still, control) for control in cell),
            "; ".join(f"--{room}: {span}" for room, span in zip(IN_A_ROW, taken, strict=True)),
        )
        for cell, taken in zip(cells, by_room, strict=True)
    )


def _control(still: Still, control: Control) -> ControlView:
    value = still.values[control.name]
    text = value_text(control, value)
    ends = (control.minimum, control.maximum) if isinstance(control, Slider) else ()
    longest = max((text, *(value_text(control, end) for end in ends)), key=len)
    return ControlView(control, f"{still.figure.id}-{control.name}", value, text, longest)


def value_text(control: Control, value: Value) -> str:
    """The value as ``controls.js`` writes it: ``f/2.8``, ``5.0 m``, ``30°``."""
    match control:
        case Slider():
            number = format_number(float(value), control.decimals)
            return with_unit(f"{control.prefix}{number}", control.unit)
        case Action():
            return control.labels[int(value)]
        case Choice():
            return control.options[str(value)]
        case _:
            return ""
