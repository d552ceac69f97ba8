"""The classes of drawings, as the style sheet declares them."""

import re
from dataclasses import dataclass
from pathlib import Path

from simulations.engine.frame import ROLES

RULE = re.compile(r"^\.overlay (text|rect)?\.([a-z]+)(?:,\n.+)* \{\n((?:  .*\n)+)\}", re.MULTILINE)
UNSEEN = ("swatch",)
"""Classes of what has a colour of its own."""


@dataclass(frozen=True, slots=True)
class Classes:
    """What a mark may be."""

    roles: tuple[str, ...]
    manners: dict[str, str]
    """With how they look: ``stroke-width: 1px``."""
    texts: tuple[str, ...]
    """Classes of labels."""


def read_classes(overlay: Path) -> Classes:
    """``overlay`` is the style sheet of drawings."""
    found = RULE.findall(overlay.read_text(encoding="utf-8"))
    looks = {name: " ".join(body.split()).rstrip(";") for text, name, body in found if not text}
    manners = {name: look for name, look in looks.items() if name not in UNSEEN}
    texts = tuple(name for text, name, _ in found if text)
    return Classes((*filter(None, ROLES), "muted"), manners, texts)
