"""``{simulation} scene-id``: a live figure. Options are the scene's controls, and ``tier``."""

import re
from collections.abc import Sequence

from markdown_it.token import Token

from simulations.engine.controls import ControlError, Slider, check_values
from simulations.engine.scene import Scene
from simulations.registry import UnknownIdError
from site_builder.book import Simulation
from site_builder.diagnostics import cause, unknown
from site_builder.markdown.blocks import read_html
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading

MAIMED_OPTION = re.compile(r":(\w+)[ =].*|(\w+)[:=].*")


def read_simulation(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> Simulation | None:
    scene = find_scene(directive.argument, directive.line, reading)
    caption_html = read_html(directive, body, reading)
    if scene is None:
        return None
    _check_caption(body, scene, reading)
    return Simulation(
        scene=scene,
        id=reading.free_id(f"figure-{scene.id}", directive.line),
        values=_read_values(directive, scene, reading),
        tier=_read_tier(directive, scene, reading),
        caption_html=caption_html,
        path=reading.path,
        line=directive.line,
    )


def find_scene(scene_id: str, line: int, reading: Reading) -> Scene | None:
    """The scene, or None and a diagnostic: unknown id, or a module that cannot be imported."""
    if not scene_id:
        reading.problem(line, "{simulation} names no scene; legal: ':::{simulation} scene-id'")
        return None
    try:
        return reading.load_scene(scene_id)
    except UnknownIdError as error:
        reading.problem(line, str(error))
    except Exception as error:  # whatever a scene's own code may raise is the author's to see
        reading.problem(line, f"simulation {scene_id!r} cannot be loaded: {cause(error)}")
    return None


def _read_values(directive: Directive, scene: Scene, reading: Reading) -> dict[str, object]:
    values: dict[str, object] = {}
    for name, option in directive.options.items():
        if name == "tier":
            continue
        try:
            value = values[name] = check_values(scene.controls, {name: option.text})[name]
        except ControlError as error:
            reading.problem(option.line, f"{scene.id}: {error}")
            continue
        control = next(control for control in scene.controls if control.name == name)
        if isinstance(control, Slider) and not control.reaches(float(value)):
            legal = f"{control.minimum:g} and steps of {control.step:g}"
            reading.problem(
                option.line, f"{scene.id}: {name}: {value:g} is between two steps; legal: {legal}"
            )
    return values


def _check_caption(body: Sequence[Token], scene: Scene, reading: Reading) -> None:
    """An option without one of its colons would be taken for the first words of the caption."""
    names = ("tier", *(control.name for control in scene.controls))
    for token in body:
        slip = MAIMED_OPTION.match(token.content) if token.type == "inline" else None
        if slip and (slip[1] or slip[2]) in names:
            line = (token.map or [0])[0] + 1
            legal = f"':{slip[1] or slip[2]}: value'"
            reading.problem(line, f"{slip[0]!r} in the caption; legal: as an option, {legal}")


def _read_tier(directive: Directive, scene: Scene, reading: Reading) -> str:
    option = directive.options.get("tier")
    if option and option.text not in scene.tiers:
        reading.problem(option.line, unknown(f"tier of {scene.id}", option.text, scene.tiers))
        return scene.default_tier
    return option.text if option else scene.default_tier
