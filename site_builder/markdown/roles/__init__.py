"""Every role, one file each or one for a family: ``{name}`words``` in running text."""

from site_builder.markdown.roles.numbers import CALC, COST, MEASURED, READOUT
from site_builder.markdown.roles.references import CITES, COLOURS, INDEX, REF, TERM
from site_builder.markdown.roles.set import SET

ROLES = (*COLOURS, REF, *CITES, TERM, INDEX, MEASURED, CALC, COST, READOUT, SET)
