"""``{ray}`the ray```: words in the colour of their idea, as in the figures."""

from site_builder.markdown.role import Role
from site_builder.markdown.text.math import COLOURS as NAMES

COLOURS = tuple(
    Role(name=name, form="words", doc="the words in the colour of their idea, as in the figures")
    for name in NAMES
)
"""One for each colour that a formula may name with ``\\role``."""
