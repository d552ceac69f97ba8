"""``{simulation} scene-id``: a live figure. Options are the scene's controls, and ``tier``."""

import re
from collections.abc import Sequence
from typing import Any

from markdown_it.token import Token

from simulations.engine.controls import ControlError, Slider
from simulations.engine.scene import Scene
from site_builder.book import Simulation
from site_builder.diagnostics import unknown
from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import Argument, Body, Directive, OptionLine, Use
from site_builder.markdown.reading import Reading
from site_builder.markdown.scenes import find_scene

MAIMED_OPTION = re.compile(r":(\w+)[ =].*|(\w+)[:=].*")


def read_simulation(use: Use, body: Sequence[Token], reading: Reading) -> Simulation | None:
    scene = find_scene(use.argument, use.line, reading)
    if scene is None:
        return None
    _check_caption(body, scene, reading)
    return Simulation(
        scene=scene,
        id=reading.free_id(f"figure-{scene.id}", use.line),
        values=_read_values(use, scene, reading),
        tier=_read_tier(use, scene, reading),
        caption_html=reading.html(body),
        path=reading.path,
        line=use.line,
    )


def _read_values(use: Use, scene: Scene[Any], reading: Reading) -> dict[str, object]:
    values: dict[str, object] = {}
    for name, option in use.options.items():
        if name == "tier":
            continue
        try:
            scene.check({name: option.text})
        except ControlError as error:
            reading.problem(option.line, f"{scene.id}: {error}")
            continue
        control = next(control for control in scene.controls if control.name == name)
        value = values[name] = control.check(option.text)  # a setting of whole things is rounded
        if isinstance(control, Slider) and not control.reaches(float(value)):
            legal = f"{control.minimum:g} and steps of {control.step:g}"
            reading.problem(
                option.line, f"{scene.id}: {name}: {value:g} is between two steps; legal: {legal}"
            )
    return values


def _check_caption(body: Sequence[Token], scene: Scene[Any], reading: Reading) -> None:
    """An option without one of its colons would be taken for the first words of the caption."""
    names = ("tier", *(control.name for control in scene.controls))
    for token in body:
        slip = MAIMED_OPTION.match(token.content) if token.type == "inline" else None
        if slip and (slip[1] or slip[2]) in names:
            line = (token.map or [0])[0] + 1
            legal = f"':{slip[1] or slip[2]}: value'"
            reading.problem(line, f"{slip[0]!r} in the caption; legal: as an option, {legal}")


def _read_tier(use: Use, scene: Scene[Any], reading: Reading) -> str:
    option = use.options.get("tier")
    if option and option.text not in scene.tiers:
        reading.problem(option.line, unknown(f"tier of {scene.id}", option.text, scene.tiers))
        return scene.default_tier
    return option.text if option else scene.default_tier


SIMULATION = Directive(
    name="simulation",
    says="a live figure",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(OptionLine("tier", says="its accuracy at first"),),
    more_options="the starting value of any control",
    body=Body("a caption", plain_tokens),
    read=read_simulation,
    template="simulation",
)
