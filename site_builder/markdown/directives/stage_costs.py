"""``{stage-costs} scene-id``: a table of what each moved control costs; the body is its caption."""

from dataclasses import dataclass

from site_builder.benchmarks.stage_costs import StageCostError, StageCosts, read_stage_costs
from site_builder.document.passage import Passage
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import LABEL, Argument, Directive, DirectiveCall, Numbered
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.scenes import find_scene


@dataclass(frozen=True, slots=True)
class StageCostTable:
    """What each moved control costs of a whole frame of one scene."""

    costs: StageCosts
    caption: Passage


def read_stage_cost_table(
    call: DirectiveCall, caption: Passage, context: ParseContext
) -> StageCostTable | None:
    scene = find_scene(call.argument, call.line, context)
    if scene is None:
        return None
    try:
        return StageCostTable(read_stage_costs(context.shared.root, scene), caption)
    except StageCostError as error:
        context.problem(call.line, str(error))
        return None


STAGE_COSTS = Directive(
    name="stage-costs",
    doc="what each control of a scene costs",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(LABEL,),
    body=CAPTION,
    read=read_stage_cost_table,
    template="stage-costs",
    numbered=Numbered("Table", lambda call: f"table-costs-{call.argument}"),
)
