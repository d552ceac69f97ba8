"""``{simulation} scene-id``: a live figure. Options are the scene's controls, ``tier``, and
``workings``: whether it shows at first how it was computed."""

from collections.abc import Sequence

from markdown_it.token import Token

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
from site_builder.markdown.scenes import find_scene, read_settings
from site_builder.page_model.blocks import Simulation
from site_builder.page_model.passage import Plain, passage


def read_simulation(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> Simulation | None:
    scene = find_scene(call.argument, call.line, context)
    if scene is None:
        return None
    given = {name: option for name, option in call.options.items() if name != "workings"}
    values = read_settings(scene, given, context)
    return Simulation(
        scene=scene,
        id=next(place.id for place in context.figures if place.lines[0] == call.line),
        tier=str(values.pop("tier", scene.default_tier)),
        values=values,
        workings_open=call.text("workings") == "open",
        caption=passage(body),
        path=context.path,
        line=call.line,
    )


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
