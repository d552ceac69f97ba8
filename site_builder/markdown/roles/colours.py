"""``{ray}`the ray```: words in the colour of their idea, as in the figures."""

from site_builder.markdown.role import Role
from site_builder.markdown.text.math import COLOURS as NAMES

COLOURS = tuple(
    Role(name=name, form="words", says=f"the words, in the colour of {name!r}") for name in NAMES
)
"""One for each colour that a formula may name with ``\\role``."""
