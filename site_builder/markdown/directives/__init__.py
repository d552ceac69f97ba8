"""Every directive, one file each or one for a family: ``:::{name} argument`` … ``:::``.

A new one needs its file here, its template in ``templates/blocks/``, and its name in this list.
"""

from typing import Any

from site_builder.markdown.directive import Directive
from site_builder.markdown.directives.callout import CALLOUTS, EXAMPLE
from site_builder.markdown.directives.download import DATA_SHEET, DOWNLOAD
from site_builder.markdown.directives.extremes import EXTREMES
from site_builder.markdown.directives.ladder import LADDER, LADDER_TABLE, STAGE_COSTS
from site_builder.markdown.directives.pictures import FIGURE, ILLUSTRATION
from site_builder.markdown.directives.questions import ANSWER, PREDICT, QUIZ
from site_builder.markdown.directives.recordings import AUDIO, VIDEO
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.markdown.directives.source import SOURCE
from site_builder.markdown.directives.table import TABLE

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
