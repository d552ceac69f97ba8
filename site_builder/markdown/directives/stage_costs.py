"""``{stage-costs} scene-id``: a table of what each moved control costs; the body is its caption."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.book import StageCostTable
from site_builder.markdown.blocks import check_options, read_html
from site_builder.markdown.directives.simulation import find_scene
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading
from site_builder.measured.stage_costs import StageCostError, read_stage_costs


def read_stage_cost_table(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> StageCostTable | None:
    check_options(directive, (), reading)
    caption_html = read_html(directive, body, reading)
    scene = find_scene(directive.argument, directive.line, reading)
    if scene is None:
        return None
    try:
        return StageCostTable(read_stage_costs(reading.root, scene), caption_html)
    except StageCostError as error:
        reading.problem(directive.line, str(error))
        return None
