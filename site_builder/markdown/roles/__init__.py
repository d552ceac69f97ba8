"""Every role, one file each or one for a family: ``{name}`words``` in running text."""

from site_builder.markdown.roles.calc import CALC
from site_builder.markdown.roles.cite import CITES
from site_builder.markdown.roles.colours import COLOURS
from site_builder.markdown.roles.cost import COST
from site_builder.markdown.roles.index import INDEX
from site_builder.markdown.roles.measured import MEASURED
from site_builder.markdown.roles.readout import READOUT
from site_builder.markdown.roles.ref import REF
from site_builder.markdown.roles.set import SET
from site_builder.markdown.roles.term import TERM

ROLES = (*COLOURS, REF, *CITES, TERM, INDEX, MEASURED, CALC, COST, READOUT, SET)
