"""A new book in a folder of its own, which names the engine that made it among its dependencies."""

import json
import sys
from importlib.metadata import distribution
from pathlib import Path

from site_builder import __version__
from site_builder.files.engine import DISTRIBUTION, ENGINE, PACKED, own_or_engine
from site_builder.scaffold.files import HERE, SUFFIX, ScaffoldError, filled, read_name

WORKFLOW = ".github/workflows/publish.yml"
"""Publishes this repository's book, and any other."""


def make_book(folder: Path) -> list[str]:
    """Write a working book into ``folder``, which must be empty or not there; its files by path.

    Raises `ScaffoldError`.
    """
    name = read_name("book", folder.resolve().name)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ScaffoldError(f"{folder} is not empty; legal: a folder that is empty or not there")
    given = {
        "name": name.text,
        "title": name.title,
        "engine": _requirement(),
        "version": __version__,
    }
    files = {
        ".python-version": f"{sys.version_info.major}.{sys.version_info.minor}\n".encode(),
        WORKFLOW: own_or_engine(ENGINE, WORKFLOW).read_bytes(),
    }
    for template in sorted((HERE / "book").rglob("*")):
        if template.is_file():
            path = template.relative_to(HERE / "book").as_posix()
            text = filled(f"book/{path}", **given) if path.endswith(SUFFIX) else None
            data = template.read_bytes() if text is None else text.encode()
            files[path.removesuffix(SUFFIX).replace("dot-", ".")] = data
    for path, data in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)
    return sorted(files)


def _requirement() -> str:
    """The engine that runs, as pip reads it: this repository or, where it is installed, what
    it came from."""
    if not PACKED.is_dir():
        return f"{DISTRIBUTION} @ {ENGINE.as_uri()}"
    origin = distribution(DISTRIBUTION).read_text("direct_url.json")
    if origin is None:
        return f"{DISTRIBUTION}=={__version__}"
    found = json.loads(origin)
    vcs = found.get("vcs_info")
    address = f"{vcs['vcs']}+{found['url']}@{vcs['commit_id']}" if vcs else found["url"]
    return f"{DISTRIBUTION} @ {address}"
