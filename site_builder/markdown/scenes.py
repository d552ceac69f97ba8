"""Finding the scene that an author names, and what its controls may be set to."""

from typing import Any

from simulations.engine.controls import ControlError, Slider, Value
from simulations.engine.scene import Scene
from site_builder.benchmarks.loading import loaded
from site_builder.diagnostics import unknown
from site_builder.markdown.parse_context import ParseContext


def find_scene(scene_id: str, line: int, context: ParseContext) -> Scene[Any] | None:
    """The scene, or None and a diagnostic: unknown id, or a module that cannot be imported."""
    try:
        return loaded("simulation", scene_id, context.shared.load_scene, LookupError)
    except LookupError as error:
        context.problem(line, str(error))
        return None


def read_setting(
    scene: Scene[Any], name: str, text: str, line: int, context: ParseContext
) -> Value | None:
    """The value of a control that an author gives; None, and a report, where it cannot take it."""
    try:
        scene.check({name: text})
    except ControlError as error:
        context.problem(line, f"{scene.id}: {error}")
        return None
    control = next(control for control in scene.controls if control.name == name)
    value = control.check(text)
    if isinstance(control, Slider) and not control.reaches(float(value)):
        expected = f"{control.minimum:g} and steps of {control.step:g}"
        message = f"{scene.id}: {name}: {value:g} is between two steps; legal: {expected}"
        context.problem(line, message)
    return value


def read_tier(scene: Scene[Any], text: str, line: int, context: ParseContext) -> str | None:
    """An accuracy that an author names; None, and a report, where the scene has no such."""
    if text in scene.tiers:
        return text
    context.problem(line, unknown(f"tier of {scene.id}", text, scene.tiers))
    return None
