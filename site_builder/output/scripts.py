"""ES modules: which files a page runs at once, and which it may ask for afterwards."""

import re
from collections.abc import Collection, Iterator, Mapping
from posixpath import dirname, normpath

from site_builder.output.assets import Content, content_bytes

COMMENT = re.compile(r"/\*.*?\*/|^\s*//.*?$", re.DOTALL | re.MULTILINE)
AT_ONCE = re.compile(r"""(?:\bfrom|(?:^|;)\s*import)\s*"(\.[^"]+)\"""", re.MULTILINE)
"""``import … from`` and ``export … from`` a relative address; joined, several on a line."""
LATER = re.compile(
    r"""\bimport\(\s*"(\.[^"]+)"\s*\)                 # when it is needed
      | \bnew\ URL\(\s*"(\.[^"]+)",\s*import\.meta\.url  # workers, style sheets
    """,
    re.VERBOSE | re.MULTILINE,
)


def imported_scripts(files: Mapping[str, Content], entry: str) -> tuple[str, ...]:
    """What the module ``entry`` of these ``files`` imports, itself or through others: nearest
    first. Named in the head of a page, they are fetched side by side and not in a chain.

    >>> pages = {"js/main.js": b'import "./dom.js";', "js/dom.js": b"", "js/other.js": b""}
    >>> imported_scripts(pages, "js/main.js")
    ('js/dom.js',)

    Raises `KeyError` where a module is not among the files.
    """
    found = [entry]
    for name in found:
        named = dict.fromkeys(_named_in(name, files[name], AT_ONCE))
        found += [one for one in named if one not in found]
    return tuple(found[1:])


def reachable(files: Mapping[str, Content], entries: Collection[str]) -> frozenset[str]:
    """Of ``files``, the ``entries`` and what they name by a relative address, and so on.

    >>> pages = {"js/main.js": b'import("./dom.js");', "js/dom.js": b"", "js/other.js": b""}
    >>> sorted(reachable(pages, ["js/main.js"]))
    ['js/dom.js', 'js/main.js']
    """
    found: set[str] = set()
    waiting = [entry for entry in entries if entry in files]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            named = _named_in(name, files[name], AT_ONCE, LATER)
            waiting += (one for one in named if one in files)
    return frozenset(found)


def _named_in(name: str, content: Content, *kinds: re.Pattern[str]) -> Iterator[str]:
    if name.endswith((".js", ".mjs")):
        text = COMMENT.sub("", content_bytes(content).decode("utf-8"))
        for match in (match for kind in kinds for match in kind.finditer(text)):
            yield normpath(f"{dirname(name)}/{match[match.lastindex or 1]}")
