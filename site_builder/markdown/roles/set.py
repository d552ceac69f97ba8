"""``{set}`k₁ to −0.20 <k1=-0.2>```: words that move a figure of the page to a setting.

What stands in ``<…>`` is settings of the nearest figure; of another one where its id, without
``figure-``, comes before them. ``tier=ID`` sets the accuracy. Each is checked as those of a
``{simulation}`` are. Where no script runs the words are a link to the figure.
"""

import json
from collections.abc import Mapping
from typing import Any
from urllib.parse import urlencode

from simulations.engine.controls import ControlError, Slider, Value
from simulations.engine.scene import Scene
from site_builder.diagnostics.diagnostic import unknown
from site_builder.markdown.directive import OptionValue
from site_builder.markdown.parse_context import FigurePlace, ParseContext
from site_builder.markdown.role import Linked, Role
from site_builder.pool.loading import loaded

FORM = "WORDS <[FIGURE] CONTROL=VALUE … [tier=ID]>"


def set_link(_words: str, given: str | None, line: int, context: ParseContext) -> Linked:
    """The link; one without attributes, and a report, where it would set nothing."""
    return Linked(_attributes(given or "", line, context))


def _attributes(given: str, line: int, context: ParseContext) -> Mapping[str, str]:
    name, pairs = _parts(given)
    settings = dict(pair.split("=", 1) for pair in pairs if "=" in pair)
    if not settings or len(settings) < len(pairs):
        context.problem(line, f"{{set}} '<{given}>'; legal: '{FORM}', each control once")
        return {}
    figure = _find_figure(name, line, context)
    scene = _load(figure, context) if figure else None
    if figure is None or scene is None:
        return {}
    options = {control: OptionValue(text, line) for control, text in settings.items()}
    values = read_settings(scene, options, context)
    leader = context.leading(figure).id
    query = urlencode({f"{leader}.{control}": _text(value) for control, value in values.items()})
    return {
        "class": "set",
        "href": f"?{query}#{leader}",
        "data-figure": figure.id,
        "data-values": json.dumps(values, ensure_ascii=False),
    }


def _parts(given: str) -> tuple[str, list[str]]:
    """The figure that is named, or nothing, and the settings."""
    first, *others = given.split() or [""]
    return ("", [first, *others]) if "=" in first else (first, others)


def _find_figure(name: str, line: int, context: ParseContext) -> FigurePlace | None:
    """The figure of that name; without one the nearest, the one before where two are as near."""
    if not context.figures:
        context.problem(line, "{set} on a page without a figure; legal: on the page of a figure")
        return None
    if not name:
        nearest = min(context.figures, key=lambda place: place.distance(line))
        context.references.append((context.placed[nearest.lines[0]], line))
        return nearest
    return context.find_figure(name, line)


def _load(figure: FigurePlace, context: ParseContext) -> Scene[Any] | None:
    """None where it cannot be loaded, which its directive reports."""
    try:
        return loaded("simulation", figure.scene_id, context.shared.load_scene, LookupError)
    except LookupError:
        return None


def _text(value: Value) -> str:
    """The value in the form that ``permalink.ts`` writes."""
    match value:
        case bool():
            return str(value).lower()
        case float():
            return f"{value:g}"
        case _:
            return str(value)


def read_settings(
    scene: Scene[Any], given: Mapping[str, OptionValue], context: ParseContext
) -> dict[str, Value]:
    """Controls as an author sets them, and the accuracy as ``tier``; those that the scene cannot
    take are reported and left out."""
    values: dict[str, Value] = {}
    for name, option in given.items():
        if name == "tier":
            if option.text in scene.accuracy.names:
                values[name] = option.text
            else:
                kind = f"tier of {scene.id}"
                context.problem(option.line, unknown(kind, option.text, scene.accuracy.names))
            continue
        try:
            scene.check({name: option.text})
        except ControlError as error:
            context.problem(option.line, f"{scene.id}: {error}")
            continue
        control = next(control for control in scene.controls if control.name == name)
        values[name] = value = control.check(option.text)
        if isinstance(control, Slider) and not control.reaches(float(value)):
            expected = f"{control.minimum:g} and steps of {control.step:g}"
            message = f"{scene.id}: {name}: {value:g} is between two steps; legal: {expected}"
            context.problem(option.line, message)
    return values


SET = Role(
    name="set",
    form=FORM,
    doc="a link that moves the nearest figure there, or the one named",
    link=set_link,
)
