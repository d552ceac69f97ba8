"""A still as its template needs it: addresses, texts and schema worked out, nothing left to do."""

from dataclasses import dataclass

from simulations.engine.controls import Action, Choice, Control, Slider, Value, describe
from simulations.engine.frame import Panel, Readout, format_number
from site_builder.embedding import json_for_html
from site_builder.stills import Still


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
class FigureView:
    """A figure, ready for ``blocks/simulation.html``."""

    id: str
    scene_id: str
    title: str
    description: str
    caption_html: str
    panels: tuple[PanelView, ...]
    readouts: tuple[Readout, ...]
    controls: tuple[ControlView, ...]
    tiers: tuple[str, ...]
    tier: str
    schema: str
    """JSON that is safe inside a script element."""


def view_figure(still: Still, assets: str) -> FigureView:
    """``assets`` is the address of the assets folder, relative to the page."""
    figure, scene, frame = still.figure, still.figure.scene, still.frame
    return FigureView(
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
        tiers=scene.tiers,
        tier=figure.tier,
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
    }


def value_text(control: Control, value: Value) -> str:
    """The value as ``controls.js`` writes it: ``f/2.8``, ``5.0 m``, ``30°``."""
    match control:
        case Slider():
            space = "" if control.unit in ("", "°") else "\u00a0"
            number = format_number(float(value), control.decimals)
            return f"{control.prefix}{number}{space}{control.unit}"
        case Action():
            return control.labels[int(value)]
        case Choice():
            return control.options[str(value)]
        case _:
            return ""
