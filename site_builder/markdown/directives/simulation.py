"""``{simulation} scene-id``: a live figure. Options are the scene's controls, ``tier``, and
``workings``: whether it shows at first how it was computed."""

import re
from collections.abc import Sequence
from typing import Any

from markdown_it.token import Token

from simulations.engine.scene import Scene
from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import Argument, Body, Directive, Numbered, OptionLine, Use
from site_builder.markdown.reading import Reading
from site_builder.markdown.scenes import find_scene, read_setting, read_tier
from site_builder.page_model.blocks import Simulation

OWN_OPTIONS = ("tier", "workings")
"""Those that are no control of the scene."""
MAIMED_OPTION = re.compile(r":(\w+)[ =].*|(\w+)[:=].*")


def read_simulation(use: Use, body: Sequence[Token], reading: Reading) -> Simulation | None:
    scene = find_scene(use.argument, use.line, reading)
    if scene is None:
        return None
    _check_caption(body, scene, reading)
    return Simulation(
        scene=scene,
        id=next(place.id for place in reading.figures if place.lines[0] == use.line),
        values=_read_values(use, scene, reading),
        tier=_read_tier(use, scene, reading),
        workings_open=use.text("workings") == "open",
        caption_html=reading.html(body),
        path=reading.path,
        line=use.line,
    )


def _read_values(use: Use, scene: Scene[Any], reading: Reading) -> dict[str, object]:
    given = {name: option for name, option in use.options.items() if name not in OWN_OPTIONS}
    values = {
        name: read_setting(scene, name, option.text, option.line, reading)
        for name, option in given.items()
    }
    return {name: value for name, value in values.items() if value is not None}


def _check_caption(body: Sequence[Token], scene: Scene[Any], reading: Reading) -> None:
    """An option without one of its colons would be taken for the first words of the caption."""
    names = (*OWN_OPTIONS, *(control.name for control in scene.controls))
    for token in body:
        slip = MAIMED_OPTION.match(token.content) if token.type == "inline" else None
        if slip and (slip[1] or slip[2]) in names:
            line = (token.map or [0])[0] + 1
            legal = f"':{slip[1] or slip[2]}: value'"
            reading.problem(line, f"{slip[0]!r} in the caption; legal: as an option, {legal}")


def _read_tier(use: Use, scene: Scene[Any], reading: Reading) -> str:
    option = use.options.get("tier")
    tier = read_tier(scene, option.text, option.line, reading) if option else None
    return tier or scene.default_tier


SIMULATION = Directive(
    name="simulation",
    says="a live figure",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(
        OptionLine("tier", says="its accuracy at first"),
        OptionLine("workings", says="how it was computed", legal=("folded", "open")),
    ),
    more_options="the starting value of any control",
    body=Body("a caption", plain_tokens),
    read=read_simulation,
    template="simulation",
    numbered=Numbered("Figure", lambda use: f"figure-{use.argument}", again=True),
)
