"""What TeX is short for: an author's macros, and units, written out before it is set."""

import re

from site_builder.markdown.text.macros import Macros, expanded
from site_builder.markdown.text.math import UnsupportedTexError, quoted
from site_builder.markdown.text.units import with_units

TAG = re.compile(r"\\tag(?![A-Za-z])")


def written_out(tex: str, macros: Macros) -> str:
    """``tex`` in the commands that `math` sets. Raises `UnsupportedTexError`."""
    if TAG.search(tex):
        raise UnsupportedTexError(rf"\tag in {quoted(tex)}; legal: once, in a displayed formula")
    return with_units(expanded(tex, macros))
