"""A still as its template needs it: addresses, texts and schema worked out, nothing left to do."""

from collections.abc import Sequence
from dataclasses import dataclass

from simulations.engine.controls import Action, Choice, Control, Slider, Value, describe
from simulations.engine.frame import Panel, Readout, StageReport, format_number
from simulations.engine.scene import Scene
from simulations.registry import load_ladder
from site_builder.book import OUTLINE
from site_builder.measured.quantities import with_unit
from site_builder.pages.embedding import json_for_html
from site_builder.pages.stills import Still

SHOW_STAGES_FROM = 10
"""A chain this long is worth seeing at once in a chapter; shorter ones, and that of the cover's
figure, wait behind their summary."""


@dataclass(frozen=True, slots=True)
class PanelView:
    """A panel and the address of its picture."""

    panel: Panel
    src: str
    """Relative to the page; nothing for a pure diagram."""


@dataclass(frozen=True, slots=True)
class ControlView:
    """A control and its starting state."""

    control: Control
    id: str
    value: Value
    text: str
    """A slider's value with its unit; a button's present label."""


@dataclass(frozen=True, slots=True)
class SimulationView:
    """A figure, ready for ``blocks/simulation.html``."""

    id: str
    scene_id: str
    title: str
    description: str
    caption_html: str
    panels: tuple[PanelView, ...]
    readouts: tuple[Readout, ...]
    controls: tuple[ControlView, ...]
    columns: tuple[int, int, int]
    """Readouts in a row where space is narrow, middling and wide."""
    tiers: tuple[tuple[str, str], ...]
    """Id and label of each accuracy, cheap to dear."""
    tier: str
    judged: bool
    """Whether the error of a frame can be told."""
    stages: tuple[StageReport, ...]
    stages_text: str
    stages_open: bool
    schema: str
    """JSON that is safe inside a script element."""


def view_simulation(still: Still, assets: str) -> SimulationView:
    """``assets`` is the address of the assets folder, relative to the page."""
    figure, scene, frame = still.figure, still.figure.scene, still.frame
    return SimulationView(
        id=figure.id,
        scene_id=scene.id,
        title=scene.title,
        description=frame.description,
        caption_html=figure.caption_html,
        panels=tuple(
            PanelView(panel, f"{assets}stills/{name}" if name else "")
            for panel in frame.panels
            for name in (still.pictures.get(panel.name, ""),)
        ),
        readouts=frame.readouts,
        controls=tuple(
            ControlView(
                control,
                f"{figure.id}-{control.name}",
                still.values[control.name],
                value_text(control, still.values[control.name]),
            )
            for control in scene.controls
        ),
        columns=(
            even_columns(len(frame.readouts), 2),
            even_columns(len(frame.readouts), 4),
            even_columns(len(frame.readouts), 6),
        ),
        tiers=tier_labels(scene),
        tier=figure.tier,
        judged=scene.error is not None,
        stages=frame.stages,
        stages_text=count_stages(frame.stages),
        stages_open=len(frame.stages) >= SHOW_STAGES_FROM and figure.path != OUTLINE,
        schema=json_for_html(schema(still)),
    )


def schema(still: Still) -> dict[str, object]:
    """What the page's script must know of the figure: controls, starting values, tiers."""
    scene = still.figure.scene
    return {
        "title": scene.title,
        "controls": [describe(control) for control in scene.controls],
        "values": dict(still.values),
        "tiers": list(scene.tiers),
        "default_tier": still.figure.tier,
        "draft_tier": scene.draft_tier,
        "drafted": list(scene.drafted),
        "drafted_in": {tier: list(names) for tier, names in scene.drafted_in.items()},
    }


def tier_labels(scene: Scene) -> tuple[tuple[str, str], ...]:
    """Each tier and what the reader sees of it: the scene's own words, or its ladder's."""
    labels = dict(scene.tier_labels)
    if scene.ladder:
        ladder = load_ladder(scene.ladder)
        labels = {tier: ladder.tier(tier).label for tier in scene.tiers} | labels
    return tuple((tier, labels[tier]) for tier in scene.tiers)


def count_stages(stages: Sequence[StageReport]) -> str:
    """``13 computed, 0 reused, 1 skipped``, as ``workings.js`` writes it."""
    counts = {"computed": 0, "reused": 0, "skipped": 0}
    for stage in stages:
        counts[stage.status] += 1
    return ", ".join(f"{count} {status}" for status, count in counts.items())


def even_columns(count: int, most: int) -> int:
    """Columns, at most ``most``, whose rows are few and whose last row is not a lonely item."""
    legal = [n for n in range(2, most + 1) if n <= count and count % n != 1]
    if not legal:
        return min(max(count, 1), most)
    fewest_rows = min(-(-count // n) for n in legal)
    return min(n for n in legal if -(-count // n) == fewest_rows)


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
