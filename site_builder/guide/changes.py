"""The chapter of the guide on what changed for authors."""

import re
from pathlib import Path

VERSION = re.compile(r"^## (.+)$", re.MULTILINE)
FOR_AUTHORS = re.compile(r"^### For authors$\n(.*?)(?=^### |\Z)", re.MULTILINE | re.DOTALL)
HEAD = """---
title: What changed
summary: What an author notices, by version of the builder.
---

The newest version comes first. What only readers notice is in the changelog of the builder.
"""


def changes_page(changelog: Path) -> str:
    """The sections ``For authors`` of a changelog, under the names of their versions."""
    _, *parts = VERSION.split(changelog.read_text(encoding="utf-8"))
    sections = [
        f"\n## {version}\n\n{found[1].strip().replace('#### ', '### ')}\n"
        for version, text in zip(parts[::2], parts[1::2], strict=True)
        if (found := FOR_AUTHORS.search(text))
    ]
    return HEAD + "".join(sections)
