"""``{simulation} scene-id``: a live figure. Options are the scene's controls, ``tier``, ``label``,
``show``: the controls and readouts that are in sight, ``yours``: whether the reader's
photographs go in, ``panels``: which of the scene's panels stand here, and ``small``: whether it is
as wide as the text, without controls. With ``with`` it is a part of a figure above, the leader,
whose settings are its own. The first paragraph of its body is the
caption, which says what to try; the others say what it shows and are folded."""

from collections.abc import Sequence
from typing import Any

from markdown_it.token import Token

from simulations.engine.scene import Scene
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

YES = ("no", "yes")
OPTIONS = (
    LABEL,
    OptionLine(name="tier", doc="its accuracy at first"),
    OptionLine(name="show", doc="the controls and readouts that are not folded"),
    OptionLine(name="panels", doc="the panels that stand here, in their order"),
    OptionLine(name="with", doc="the figure above whose settings are its own"),
    OptionLine(
        name="small", doc="whether it is as wide as the text, without controls", expected=YES
    ),
    OptionLine(name="yours", doc="whether the reader’s photographs go in", expected=YES),
)
FOR_THE_PAGE = tuple(option.name for option in OPTIONS if option.name != "tier")
"""Options that are no settings of the scene."""
FIRST = 3
"""Tokens of the first paragraph."""


def read_simulation(
    call: DirectiveCall, body: Sequence[Token], context: ParseContext
) -> Simulation | None:
    scene = loaded("simulation", call.argument, context.shared.load_scene, CodeError)
    given = {name: option for name, option in call.options.items() if name not in FOR_THE_PAGE}
    leader = _find_leader(scene, call, context) if "with" in call.options else None
    if "with" in call.options and leader is None:
        return None
    values: dict[str, object] = (
        {**leader.values, "tier": leader.tier}
        if leader
        else {**read_settings(scene, given, context)}
    )
    yours = call.text("yours") == "yes"
    if yours and not leader and not scene.instrument.measures_photographs:
        message = f"{scene.id} measures no photographs; ':yours:' is for a scene that does"
        context.problem(call.line_of("yours"), message)
    figure = Simulation(
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
        panels=tuple(dict.fromkeys(call.text("panels").split())),
        leader=leader.id if leader else "",
        small=call.text("small") == "yes",
    )
    context.simulations[figure.id] = figure
    return figure


def _find_leader(
    scene: Scene[Any], call: DirectiveCall, context: ParseContext
) -> Simulation | None:
    """The figure whose settings a part shares; None, and a report, where it cannot be that."""
    name, line = call.text("with"), call.line_of("with")
    place = context.find_figure(name, line)
    if place is None:
        return None
    own = [option for option in call.options if option not in FOR_THE_PAGE]
    for option in own + ["yours"] * (call.text("yours") == "yes"):
        message = f"':{option}:' on a part of {name!r}; legal: on that figure itself"
        context.problem(call.line_of(option), message)
    if place.lines[0] >= call.line:
        context.problem(line, f"{name!r} does not stand above; legal: a figure above its parts")
    elif place.leader:
        expected = f"its leader, {context.leading(place).id!r}"
        context.problem(line, f"{name!r} is itself a part; legal: {expected}")
    elif place.scene_id != scene.id:
        message = f"{name!r} shows the scene {place.scene_id!r}; legal: a figure of {scene.id!r}"
        context.problem(line, message)
    else:
        return context.simulations.get(place.id)  # none where its own mistakes are reported
    return None


SIMULATION = Directive(
    name="simulation",
    doc="a live figure",
    argument=Argument("scene-id", lacks="names no scene"),
    options=OPTIONS,
    more_options="the starting value of any control",
    body=Body("what to try, and in further paragraphs what it shows", plain_tokens),
    read=read_simulation,
    template="simulation",
    numbered=Numbered("Figure", lambda call: f"figure-{call.argument}", again=True),
    plain=lambda figure: Plain(
        (*(() if figure.leader else (figure.scene.title,)), figure.caption, figure.about), "figure"
    ),
)
