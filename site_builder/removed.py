"""Names of earlier versions that authors may still have in their sources, and what replaces them.

The message about an unknown name adds it, at the line that uses the name.
"""

REMOVED = {
    ("directive", "admonition"): "{note}, {tip}, {warning} and {key-idea} take a title (0.2)",
    ("directive", "include"): "a chapter is one file (0.2)",
    ("directive", "tabs"): "sections, or a figure with a menu (0.2)",
    ("directive", "tab"): "sections, or a figure with a menu (0.2)",
    ("option", "uses"): "import in a `calc` code block what expressions call (0.2)",
    ("key", "fonts"): "faces are in static/css/fonts.css (0.2)",
    ("key", "theme"): "colours are in static/css/tokens.css, which a book may replace (0.2)",
}
"""By the first word of the kind, and the name. In brackets, the version without it."""


def replacement(kind: str, name: str) -> str:
    """Nothing where no version had such a name."""
    return REMOVED.get((kind.split()[0], name), "")
