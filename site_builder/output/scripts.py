"""Which scripts a page runs: named in its head, they are fetched side by side and not in a chain."""

import re
from collections.abc import Mapping
from posixpath import dirname, join, normpath

from site_builder.output.assets import Content, content_bytes

IMPORT = re.compile(r"""^(?:import|export)\b[^"'();]*["'](\.[^"']+)["'];""", re.MULTILINE)
"""A static import by a relative address; scripts that are imported in functions come later."""


def imported_scripts(files: Mapping[str, Content], entry: str) -> tuple[str, ...]:
    """What the module ``entry`` of these ``files`` imports, itself or through others: nearest first.

    Raises `KeyError` where a module is not among the files.
    """
    found = [entry]
    for name in found:
        text = content_bytes(files[name]).decode("utf-8")
        reached = (normpath(join(dirname(name), address)) for address in IMPORT.findall(text))
        found += dict.fromkeys(one for one in reached if one not in found)
    return tuple(found[1:])
