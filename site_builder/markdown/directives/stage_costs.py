"""``{stage-costs} scene-id``: a table of what each moved control costs; the body is its caption."""

from dataclasses import dataclass

from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import LABEL, Argument, Directive, Numbered, Use
from site_builder.markdown.reading import Reading
from site_builder.markdown.scenes import find_scene
from site_builder.measured.stage_costs import StageCostError, StageCosts, read_stage_costs


@dataclass(frozen=True, slots=True)
class StageCostTable:
    """What each moved control costs of a whole frame of one scene."""

    costs: StageCosts
    caption_html: str


def read_stage_cost_table(use: Use, caption_html: str, reading: Reading) -> StageCostTable | None:
    scene = find_scene(use.argument, use.line, reading)
    if scene is None:
        return None
    try:
        return StageCostTable(read_stage_costs(reading.root, scene), caption_html)
    except StageCostError as error:
        reading.problem(use.line, str(error))
        return None


STAGE_COSTS = Directive(
    name="stage-costs",
    says="what each control of a scene costs",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(LABEL,),
    body=CAPTION,
    read=read_stage_cost_table,
    template="stage-costs",
    numbered=Numbered("Table", lambda use: f"table-costs-{use.argument}"),
)
