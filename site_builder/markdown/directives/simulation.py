"""``{simulation} scene-id``: a live figure. Options are the scene's controls, ``tier``, and
``workings``: whether it shows at first how it was computed."""

from collections.abc import Sequence
from typing import Any

from markdown_it.token import Token

from simulations.engine.scene import Scene
from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import (
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.scenes import find_scene, read_setting, read_tier
from site_builder.page_model.blocks import Simulation
from site_builder.page_model.passage import Plain, passage

OWN_OPTIONS = ("tier", "workings")
"""Those that are no control of the scene."""


def read_simulation(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> Simulation | None:
    scene = find_scene(call.argument, call.line, context)
    if scene is None:
        return None
    return Simulation(
        scene=scene,
        id=next(place.id for place in context.figures if place.lines[0] == call.line),
        values=_read_values(call, scene, context),
        tier=_read_tier(call, scene, context),
        workings_open=call.text("workings") == "open",
        caption=passage(body),
        path=context.path,
        line=call.line,
    )


def _read_values(
    call: DirectiveCall, scene: Scene[Any], context: ParseContext
) -> dict[str, object]:
    given = {name: option for name, option in call.options.items() if name not in OWN_OPTIONS}
    values = {
        name: read_setting(scene, name, option.text, option.line, context)
        for name, option in given.items()
    }
    return {name: value for name, value in values.items() if value is not None}


def _read_tier(call: DirectiveCall, scene: Scene[Any], context: ParseContext) -> str:
    option = call.options.get("tier")
    tier = read_tier(scene, option.text, option.line, context) if option else None
    return tier or scene.default_tier


SIMULATION = Directive(
    name="simulation",
    doc="a live figure",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(
        OptionLine("tier", doc="its accuracy at first"),
        OptionLine("workings", doc="how it was computed", expected=("folded", "open")),
    ),
    more_options="the starting value of any control",
    body=Body("a caption", plain_tokens),
    read=read_simulation,
    template="simulation",
    numbered=Numbered("Figure", lambda call: f"figure-{call.argument}", again=True),
    plain=lambda figure: Plain((figure.scene.title, figure.caption), "figure"),
)
