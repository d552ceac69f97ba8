"""ES modules: which files the browser may ask for once it has one."""

import re
from collections.abc import Collection, Iterator, Mapping
from posixpath import dirname, normpath

from site_builder.output.assets import Content, content_bytes

COMMENT = re.compile(r"/\*.*?\*/|^\s*//.*?$", re.DOTALL | re.MULTILINE)
ADDRESS = re.compile(
    r"""(?:\bfrom|^\s*import)\s*"(\.[^"]+)"           # import and export … from
      | \bimport\(\s*"(\.[^"]+)"\s*\)                 # when it is needed
      | \bnew\ URL\(\s*"(\.[^"]+)",\s*import\.meta\.url  # workers, style sheets
    """,
    re.VERBOSE | re.MULTILINE,
)


def reachable(files: Mapping[str, Content], entries: Collection[str]) -> frozenset[str]:
    """Of ``files``, the ``entries`` and what they name by a relative address, and so on.

    >>> pages = {"js/main.js": b'import "./dom.js";', "js/dom.js": b"", "js/other.js": b""}
    >>> sorted(reachable(pages, ["js/main.js"]))
    ['js/dom.js', 'js/main.js']
    """
    found: set[str] = set()
    waiting = [entry for entry in entries if entry in files]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += (named for named in _named_in(name, files[name]) if named in files)
    return frozenset(found)


def _named_in(name: str, content: Content) -> Iterator[str]:
    if not name.endswith(".js"):
        return
    text = COMMENT.sub("", content_bytes(content).decode("utf-8"))
    for match in ADDRESS.finditer(text):
        yield normpath(f"{dirname(name)}/{match[match.lastindex or 1]}")
