"""``{simulation} scene-id``: a live figure. Options are the scene's controls, ``tier``, ``label``,
``show``: the controls and readouts that are in sight, and ``yours``: whether the reader's
photographs go in. The first paragraph of its body is the
caption, which says what to try; the others say what it shows and are folded."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.diagnostics.blame import CodeError
from site_builder.document.blocks import Simulation
from site_builder.document.places import Plain, passage
from site_builder.markdown.block_tree import plain_tokens
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.roles.set import read_settings
from site_builder.pool.loading import loaded

FOR_THE_PAGE = ("show", "yours", LABEL.name)
"""Options that are no settings of the scene."""
FIRST = 3
"""Tokens of the first paragraph."""


def read_simulation(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> Simulation:
    scene = loaded("simulation", call.argument, context.shared.load_scene, CodeError)
    given = {name: option for name, option in call.options.items() if name not in FOR_THE_PAGE}
    values = read_settings(scene, given, context)
    yours = call.text("yours") == "yes"
    if yours and not scene.instrument.measures_photographs:
        message = f"{scene.id} measures no photographs; ':yours:' is for a scene that does"
        context.problem(call.line_of("yours"), message)
    return Simulation(
        scene=scene,
        id=next(place.id for place in context.figures if place.lines[0] == call.line),
        tier=str(values.pop("tier", scene.accuracy.default)),
        values=values,
        caption=passage(body[:FIRST]),
        about=passage(body[FIRST:]),
        path=context.path,
        line=call.line,
        in_sight=tuple(call.text("show").split()),
        yours=yours,
    )


SIMULATION = Directive(
    name="simulation",
    doc="a live figure",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(
        LABEL,
        OptionLine(name="tier", doc="its accuracy at first"),
        OptionLine(name="show", doc="the controls and readouts that are not folded"),
        OptionLine(
            name="yours", doc="whether the reader’s photographs go in", expected=("no", "yes")
        ),
    ),
    more_options="the starting value of any control",
    body=Body("what to try, and in further paragraphs what it shows", plain_tokens),
    read=read_simulation,
    template="simulation",
    numbered=Numbered("Figure", lambda call: f"figure-{call.argument}", again=True),
    plain=lambda figure: Plain((figure.scene.title, figure.caption, figure.about), "figure"),
)
