"""The view of a figure for its template: addresses, texts, controls, readouts and schema."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Any

from simulations.engine.controls import Control, Points, Value, describe
from simulations.engine.frame import Panel, Place, Readout, StageReport
from simulations.engine.handles import Handle
from simulations.engine.ladder import Ladder
from simulations.engine.message import Message
from simulations.engine.photograph import Whole
from simulations.registry import level_labels, load_ladder
from site_builder.benchmarks.judgements import with_unit
from site_builder.benchmarks.quoted_numbers import LevelCosts
from site_builder.document.blocks import Simulation
from site_builder.document.book import Chapter
from site_builder.figures.initial_frames import InitialFrame, InitialFrames
from site_builder.files.engine import ENGINE
from site_builder.files.folders import address_of
from site_builder.languages.words import ENGLISH, Words
from site_builder.pages.policy import json_for_html
from site_builder.pool.loading import loaded

CONTROL_KINDS = ENGINE / "simulations" / "engine" / "controls"
"""Where the kinds of controls lie."""
CONTROLS_IN_SIGHT, NUMBERS_IN_SIGHT = 2, 1
"""Controls and readouts that a figure shows at first; the others are folded."""
TIER, AUTOMATIC = "tier", "automatic"
"""Name of the menu of accuracies, and its first entry."""


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
    initial_frame: InitialFrame, *, tiers: bool, words: Words = ENGLISH
) -> tuple[tuple[Cell, ...], tuple[Cell, ...]]:
    """The cells in sight, and the folded ones.

    In sight are the controls that the author of the page names, else the first: a scene states its
    settings in the order of their weight.
    """
    runs = [*gather_buttons(initial_frame.figure.scene.controls), *([()] if tiers else [])]
    names = [[control.name for control in run] or [TIER] for run in runs]
    places = {name: place for place, run in enumerate(names) for name in run}
    chosen = dict.fromkeys(places[name] for name in initial_frame.figure.in_sight if name in places)
    shown = [runs[place] for place in chosen] or [run for run in runs if run][:CONTROLS_IN_SIGHT]
    folded = [run for run in runs if run not in shown]
    cells = [
        tuple(tuple(_control(initial_frame, control, words) for control in run) for run in part)
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


def readouts_in_sight(
    initial_frame: InitialFrame,
) -> tuple[tuple[Readout, ...], tuple[Readout, ...]]:
    """The readouts in sight, and the folded ones: those that the author names, else the first."""
    readouts, named = initial_frame.frame.readouts, initial_frame.figure.in_sight
    chosen = tuple(shown for shown in readouts if shown.name in named)
    shown = chosen if named else readouts[:NUMBERS_IN_SIGHT]
    return shown, tuple(each for each in readouts if each not in shown)


def _control(initial_frame: InitialFrame, control: Control, words: Words) -> ControlView:
    value = initial_frame.values[control.name]
    text = value_text(control, value, words)
    ends = (value_text(control, end, words) for end in control.extremes())
    longest = max((text, *ends), key=len)
    return ControlView(control, f"{initial_frame.figure.id}-{control.name}", value, text, longest)


def value_text(control: Control, value: Value, words: Words = ENGLISH) -> str:
    """The value as ``formatValue`` in ``static/js/page/text.ts`` writes it: ``f/2.8``, ``30°``."""
    return with_unit(*control.text(value, words.numeral))


SECOND = 0.53
"""Width of a panel beside one that leads, as a share of that one's (``static/css/figure.css``)."""
ROOM = 0.24
"""Height that controls and readouts need there, as a share of the same width."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HandleView:
    """What can be grabbed in a panel, and where it is at first."""

    handle: Handle[Any]
    name: str
    """For screen readers: its label, with the panel's title where others have the same."""
    place: Place | None
    """Nothing where it cannot be grabbed as the figure starts."""
    text: str
    """Its value for screen readers: ``Light angle 30°``."""
    range: tuple[float, float, float] | None
    """Least, present and greatest value of what it drives first; of a menu, places in it."""
    keys: str
    """What the arrow keys do."""
    hint: str
    """What a hand does: ``Drag the lamp``."""


@dataclass(frozen=True, slots=True)
class PanelView:
    """A panel and the address of its picture."""

    panel: Panel
    src: str
    """Relative to the page; nothing for a pure diagram."""
    size: tuple[int, int]
    """Pixels of the picture."""
    handles: tuple[HandleView, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulationView:
    """A figure, ready for ``blocks/simulation.html``, beside what its directive says."""

    name: str
    """The scene's title, numbered where the page shows the scene again."""
    description: str
    panels: tuple[PanelView, ...]
    """The one that leads first."""
    small: bool
    """Whether it is as wide as the text, its controls out of sight."""
    cells: tuple[Cell, ...]
    """Controls in sight."""
    folded_cells: tuple[Cell, ...]
    readouts: tuple[Readout, ...]
    """Readouts in sight."""
    folded_readouts: tuple[Readout, ...]
    tiers: tuple[tuple[str, str], ...]
    """Name and label of each level, cheap to accurate."""
    tier: str
    """What the menu of levels says at first."""
    stages: tuple[StageReport, ...]
    stages_text: str
    schema: str
    """JSON that is safe inside a script element; nothing for a part, whose leader has it."""
    prerendered: str
    """Address of what can be shown before Python has started; nothing where that is nothing."""
    sounds: bool
    """Whether it can be heard."""
    takes_picture: bool
    """Whether the reader can show a picture in place of the book's."""
    makes_files: bool
    """Whether there are files to save: those of an instrument only where it has the reader's
    photographs."""
    frame_height: int
    """Pixels of a frame in another page, 730 px wide or more, that shows all of the figure."""

    @property
    def side(self) -> str:
        """Where controls and readouts stand on a wide page: ``beside`` the only panel, or
        ``beneath`` a second one that is low beside the first; else below all panels."""
        if self.small:
            return ""
        if len(self.panels) == 1:
            return "beside" if self.readouts or self.cells else ""
        first, second = (view.panel for view in self.panels[:2])
        room = first.height / first.width - SECOND * second.height / second.width
        return "beneath" if len(self.panels) == 2 and first.lead and room > ROOM else ""


def view_simulation(
    initial_frame: InitialFrame,
    assets: str,
    words: Words = ENGLISH,
    recorded: LevelCosts | None = None,
) -> SimulationView:
    """``assets`` is the address of the assets folder, relative to the page; ``recorded`` are the
    milliseconds of frames by level and control."""
    figure, scene = initial_frame.figure, initial_frame.figure.scene
    frame, tiers = initial_frame.frame, level_labels(scene, _ladder)
    prerendered = initial_frame.prerendered
    instrument = scene.instrument
    count = len(frame.panels)
    has_menu = bool(tiers) and not figure.leader
    cells, folded_cells = control_cells(initial_frame, tiers=has_menu, words=words)
    readouts, folded_readouts = readouts_in_sight(initial_frame)
    return SimulationView(
        name=_name(figure),
        description=frame.description,
        panels=tuple(
            PanelView(
                panel,
                *_picture(initial_frame, panel.name, assets),
                _handles(initial_frame, panel.name, words),
            )
            for panel in ordered(frame.panels, figure)
        ),
        small=figure.small,
        cells=cells,
        folded_cells=folded_cells,
        readouts=_numerals(readouts, words),
        folded_readouts=_numerals(folded_readouts, words),
        tiers=tiers,
        tier=menu_tier(figure),
        stages=tuple(
            replace(stage, reason=reason_text(stage.reason, words)) for stage in frame.stages
        ),
        stages_text=count_stages(frame.stages, words),
        schema="" if figure.leader else json_for_html(schema(initial_frame, recorded or {})),
        prerendered=f"{assets}prerendered/{prerendered.file}" if prerendered else "",
        sounds=frame.sound is not None,
        takes_picture=instrument.photograph is not None and not instrument.measures_photographs,
        makes_files=_makes_files(figure),
        frame_height=800 + 120 * (count > 2) + 250 * (count > 3) + 180 * figure.yours,
    )


def ordered(panels: Sequence[Panel], figure: Simulation) -> list[Panel]:
    """As the author of the page names them, else the one that leads first."""
    return list(panels) if figure.panels else sorted(panels, key=lambda panel: not panel.lead)


def _ladder(ladder_id: str) -> Ladder:
    return loaded("ladder", ladder_id, load_ladder, LookupError)


def _numerals(readouts: Sequence[Readout], words: Words) -> tuple[Readout, ...]:
    return tuple(replace(shown, text=words.numeral(shown.text)) for shown in readouts)


def _picture(initial_frame: InitialFrame, panel: str, assets: str) -> tuple[str, tuple[int, int]]:
    """Address and size of a panel's pixels."""
    picture = initial_frame.pictures.get(panel)
    if picture is None:
        return "", (0, 0)
    return f"{assets}stills/{address_of(picture.file)}", (picture.width, picture.height)


def _name(figure: Simulation) -> str:
    number = figure.id.removeprefix(f"figure-{figure.scene.id}").removeprefix("-")
    return f"{figure.scene.title} ({number})" if number else figure.scene.title


def _handles(initial_frame: InitialFrame, panel: str, words: Words) -> tuple[HandleView, ...]:
    """The handles of one panel, in the scene's order."""
    scene = initial_frame.figure.scene
    places = {place.name: place for place in initial_frame.frame.handles}
    controls = {control.name: control for control in scene.controls}
    labels = [handle.label for handle in scene.handles]
    title = next(shown.title for shown in initial_frame.frame.panels if shown.name == panel)

    def view(handle: Handle[Any]) -> HandleView:
        driven = [controls[name] for name in handle.drives]
        values = initial_frame.values
        said = (f"{item.label} {value_text(item, values[item.name], words)}" for item in driven)
        reach = None
        if len(driven) == 1 and not isinstance(driven[0], Points):
            reach = driven[0].span(values[driven[0].name])
        place = places.get(handle.name)
        is_shared = labels.count(handle.label) > 1
        return HandleView(
            handle=handle,
            name=f"{handle.label}, {title}" if is_shared else handle.label,
            place=place,
            text=", ".join(said),
            range=reach,
            keys=_keys(driven, words),
            hint=_hint(handle, words),
        )

    return tuple(view(handle) for handle in scene.handles if handle.panel == panel)


def _hint(handle: Handle[Any], words: Words) -> str:
    key = "figure.press" if handle.reach == "aim" else "figure.drag"
    label = handle.label
    begins = words(key, handle="").startswith(" ")
    return words(key, handle=label if begins else label[:1].lower() + label[1:])


def _keys(driven: Sequence[Control], words: Words) -> str:
    if isinstance(driven[0], Points):
        return words("figure.arrows_move")
    if len(driven) == 1:
        return words("figure.arrows", control=driven[0].label)
    across, along = (control.label for control in driven)
    return words("figure.arrows_both", across=across, along=along)


def menu_tier(figure: Simulation) -> str:
    """What the menu of accuracies says at first: a level that the author of the page chose."""
    return AUTOMATIC if figure.tier == figure.scene.accuracy.default else figure.tier


def schema(initial_frame: InitialFrame, recorded: LevelCosts) -> dict[str, object]:
    """What the page's script must know of the figure: controls, starting values, levels and
    their times; of a photograph width and height in px, or most megapixels, and whether the
    figure itself takes the cells of raw files."""
    scene = initial_frame.figure.scene
    photograph = scene.instrument.photograph
    return {
        "title": scene.title,
        "controls": [describe(control) for control in scene.controls],
        "values": dict(initial_frame.values),
        "tiers": list(scene.accuracy.names),
        "default_tier": scene.accuracy.default,
        "tier": menu_tier(initial_frame.figure),
        "within": dict(scene.accuracy.within),
        "recorded": dict(recorded),
        "photograph": photograph.most_megapixels if isinstance(photograph, Whole) else photograph,
        "mosaic": scene.instrument.reads_mosaics and scene.instrument.read is None,
    }


def _makes_files(figure: Simulation) -> bool:
    instrument = figure.scene.instrument
    if instrument.measures_photographs:
        return figure.yours and bool(instrument.exports or instrument.develop)
    return bool(instrument.exports)


def reason_text(reason: str | Sequence[Message], words: Words = ENGLISH) -> str:
    """Why a stage was computed or not, as ``stage_report.ts`` writes it."""
    if isinstance(reason, str):
        return reason
    return "; ".join(words(f"script.{part.key}", **part.values) for part in reason)


def count_stages(stages: Sequence[StageReport], words: Words = ENGLISH) -> str:
    """``13 computed, 0 reused, 1 skipped``, as ``stage_report.ts`` writes it."""
    counts = {"computed": 0, "reused": 0, "skipped": 0}
    for stage in stages:
        counts[stage.status] += 1
    return words("script.stage_report.count", **counts)


def thumbnail(chapter: Chapter, initial_frames: InitialFrames) -> InitialFrame | None:
    """The chapter's first figure with a picture in its main panel, else its first; None where it
    has no figure."""
    frames = [initial_frames[figure.path, figure.line] for figure in chapter.simulations]
    with_picture = (frame for frame in frames if frame.main_panel.name in frame.pictures)
    return next(with_picture, next(iter(frames), None))
