"""Every directive, one file each or one for a family: ``:::{name} argument`` … ``:::``.

A new one needs its file here, its template in ``templates/blocks/``, and its name in this list.
"""

from typing import Any

from site_builder.markdown.directive import Directive
from site_builder.markdown.directives.answer import ANSWER
from site_builder.markdown.directives.audio import AUDIO
from site_builder.markdown.directives.callout import CALLOUTS
from site_builder.markdown.directives.data_sheet import DATA_SHEET
from site_builder.markdown.directives.download import DOWNLOAD
from site_builder.markdown.directives.example import EXAMPLE
from site_builder.markdown.directives.extremes import EXTREMES
from site_builder.markdown.directives.figure import FIGURE
from site_builder.markdown.directives.illustration import ILLUSTRATION
from site_builder.markdown.directives.ladder import LADDER
from site_builder.markdown.directives.ladder_table import LADDER_TABLE
from site_builder.markdown.directives.predict import PREDICT
from site_builder.markdown.directives.quiz import QUIZ
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.markdown.directives.source import SOURCE
from site_builder.markdown.directives.stage_costs import STAGE_COSTS
from site_builder.markdown.directives.table import TABLE
from site_builder.markdown.directives.video import VIDEO

DIRECTIVES: tuple[Directive[Any], ...] = (
    SIMULATION,
    QUIZ,
    PREDICT,
    ANSWER,
    *CALLOUTS,
    EXAMPLE,
    SOURCE,
    ILLUSTRATION,
    FIGURE,
    VIDEO,
    AUDIO,
    DOWNLOAD,
    TABLE,
    EXTREMES,
    LADDER,
    LADDER_TABLE,
    STAGE_COSTS,
    DATA_SHEET,
)
"""In the order of the author's guide."""
