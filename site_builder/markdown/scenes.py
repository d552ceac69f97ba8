"""Finding the scene that an author names, and what its controls may be set to."""

from collections.abc import Mapping
from typing import Any

from simulations.engine.controls import ControlError, Slider, Value
from simulations.engine.scene import Scene
from site_builder.diagnostics.blame import CodeError, raised_by_code
from site_builder.diagnostics.diagnostic import unknown
from site_builder.markdown.directive import OptionValue
from site_builder.markdown.parse_context import ParseContext
from site_builder.sandbox.loading import loaded


def find_scene(scene_id: str, line: int, context: ParseContext) -> Scene[Any] | None:
    """The scene, or None and a diagnostic: unknown id, or a module that cannot be imported."""
    try:
        return loaded("simulation", scene_id, context.shared.load_scene, CodeError)
    except LookupError as error:
        context.problem(line, str(error), raised_by_code(error))
        return None


def read_settings(
    scene: Scene[Any], given: Mapping[str, OptionValue], context: ParseContext
) -> dict[str, Value]:
    """Controls as an author sets them, and the accuracy as ``tier``; those that the scene cannot
    take are reported and left out."""
    values: dict[str, Value] = {}
    for name, option in given.items():
        if name == "tier":
            if option.text in scene.tiers:
                values[name] = option.text
            else:
                kind = f"tier of {scene.id}"
                context.problem(option.line, unknown(kind, option.text, scene.tiers))
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
