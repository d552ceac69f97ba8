"""Every directive, one file each or one for a family: ``:::{name} argument`` … ``:::``.

A new one needs its file here, its template in ``templates/blocks/``, its name in this list, an
example in ``guide/examples/``, and a function in ``editions/notebooks/directive_cells.py``. The
template has ``paper`` where paper differs; ``plain`` gives its plain words, without which neither
it nor the blocks inside it are searched or counted. Classes of ``static/css/shared.css`` come
first, then rules in the file of its family; ``screen`` and ``scripted`` mark what paper, or a page
without scripts, lacks.
"""

from typing import Any

from site_builder.markdown.directive import Directive
from site_builder.markdown.directives.boxes import CALLOUTS, EXAMPLE, TABLE
from site_builder.markdown.directives.measured import (
    DATA_SHEET,
    EXTREMES,
    LADDER,
    LADDER_TABLE,
    STAGE_COSTS,
)
from site_builder.markdown.directives.pictures import FIGURE, ILLUSTRATION
from site_builder.markdown.directives.questions import ANSWER, EXERCISE, PREDICT, QUIZ
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.markdown.directives.source import SOURCE

DIRECTIVES: tuple[Directive[Any], ...] = (
    SIMULATION,
    QUIZ,
    EXERCISE,
    PREDICT,
    ANSWER,
    *CALLOUTS,
    EXAMPLE,
    SOURCE,
    ILLUSTRATION,
    FIGURE,
    TABLE,
    EXTREMES,
    LADDER,
    LADDER_TABLE,
    STAGE_COSTS,
    DATA_SHEET,
)
"""In the order of the author's guide."""
