"""The controls and readouts of a figure: texts, and which are in sight."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from simulations.engine.controls import Control, Value
from simulations.engine.frame import Readout
from site_builder.benchmarks.quantities import with_unit
from site_builder.figures.initial_frames import InitialFrame
from site_builder.files.engine import ENGINE
from site_builder.languages.words import ENGLISH, Words

FOLDER = ENGINE / "simulations" / "engine" / "controls"
"""Where the kinds of controls lie."""
IN_SIGHT = 3
"""Controls, and readouts, that a figure shows at first; the others are folded."""
TIER = "tier"
"""Name of the menu of accuracies."""


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


type Cell = tuple[ControlView, ...]
"""A control, or buttons in a run; empty for the menu of accuracies."""


def control_cells(
    still: InitialFrame, *, tiers: bool, words: Words = ENGLISH
) -> tuple[tuple[Cell, ...], tuple[Cell, ...]]:
    """The cells in sight, and the folded ones.

    In sight are the controls that the author of the page names, else the first: a scene states its
    settings in the order of their weight.
    """
    runs = [*gather_buttons(still.figure.scene.controls), *([()] if tiers else [])]
    names = [[control.name for control in run] or [TIER] for run in runs]
    places = {name: place for place, run in enumerate(names) for name in run}
    chosen = dict.fromkeys(places[name] for name in still.figure.in_sight if name in places)
    shown = [runs[place] for place in chosen] or [run for run in runs if run][:IN_SIGHT]
    folded = [run for run in runs if run not in shown]
    cells = [
        tuple(tuple(_control(still, control, words) for control in run) for run in part)
        for part in (shown, folded)
    ]
    return cells[0], cells[1]


def gather_buttons(controls: Sequence[Control]) -> list[tuple[Control, ...]]:
    """Each control by itself, but buttons that follow each other together."""
    runs: list[tuple[Control, ...]] = []
    for is_action, run in groupby(controls, key=lambda control: control.kind == "action"):
        together = tuple(run)
        runs += [together] if is_action else [(control,) for control in together]
    return runs


def readouts_in_sight(still: InitialFrame) -> tuple[tuple[Readout, ...], tuple[Readout, ...]]:
    """The readouts in sight, and the folded ones: those that the author names, else the first."""
    readouts, named = still.frame.readouts, still.figure.in_sight
    chosen = tuple(shown for shown in readouts if shown.name in named)
    shown = chosen if named else readouts[:IN_SIGHT]
    return shown, tuple(each for each in readouts if each not in shown)


def _control(still: InitialFrame, control: Control, words: Words) -> ControlView:
    value = still.values[control.name]
    text = value_text(control, value, words)
    ends = (value_text(control, end, words) for end in control.extremes())
    longest = max((text, *ends), key=len)
    return ControlView(control, f"{still.figure.id}-{control.name}", value, text, longest)


def value_text(control: Control, value: Value, words: Words = ENGLISH) -> str:
    """The value as ``formatValue`` in ``static/js/page/text.ts`` writes it: ``f/2.8``, ``30°``."""
    return with_unit(*control.text(value, words.numeral))
