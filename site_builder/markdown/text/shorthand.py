"""What TeX is short for: an author's macros, units and chemistry, written out before it is set."""

from site_builder.markdown.text.chemistry import with_chemistry
from site_builder.markdown.text.macros import Macros, expanded
from site_builder.markdown.text.units import with_units


def written_out(tex: str, macros: Macros) -> str:
    """``tex`` in the commands that `math` sets. Raises `UnsupportedTexError`."""
    return with_chemistry(with_units(expanded(tex, macros)))
