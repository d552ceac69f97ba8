"""The modules of a page in few files: one of its own costs a browser more than what is in it."""

import json
import re
import tempfile
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from platformdirs import user_cache_path

from site_builder.editor.npm import HERE as PACKAGES
from site_builder.editor.npm import installed_packages, run_node
from site_builder.output.assets import Content, content_bytes, content_hash
from site_builder.output.scripts import imported_scripts, reachable
from site_builder.runtime.store import made_once, sha256

DRIVER = Path(__file__).with_name("join_scripts.mjs")
WORKER = re.compile(r'\bnew URL\("\./([\w-]+\.js)", import\.meta\.url\)')
"""The address of a script that is none of the page's own."""
JOINED = "joined.json"
"""What is kept: the joined files' texts by name, and the names of the modules that are in them."""


def join_scripts(
    files: Mapping[str, Content], entry: str, kept: Path | None = None
) -> Mapping[str, Content]:
    """``files`` with the module ``entry`` holding what it imports, and each worker likewise.

    What is imported later stays in files of its own, and what these share with the page; their
    names say what is in them. Entry and workers keep theirs. What was joined once lies in the
    folder ``kept``.

    Raises
    ------
    NodeError
        Where the packages that join cannot be had, or modules do not fit together.
    """
    if not imported_scripts(files, entry):
        return files
    modules = {
        name: content
        for name, content in files.items()
        if name in reachable(files, [entry]) and name.endswith(".js")
    }
    folder = kept or user_cache_path("image-formation", appauthor=False) / "scripts"
    given = [(name, content_hash(modules[name]).hex()) for name in sorted(modules)]
    tool = [sha256(path.read_bytes()) for path in (DRIVER, PACKAGES / "package-lock.json")]
    recipe = sha256(json.dumps([entry, given, tool]).encode())
    found = made_once(folder, recipe, partial(_join, modules, entry))
    joined, taken = json.loads(found[JOINED].read_bytes())
    rest = {name: content for name, content in files.items() if name not in taken}
    return {**rest, **{name: text.encode() for name, text in joined.items()}}


def workers_of(modules: Mapping[str, Content]) -> list[str]:
    """Scripts that modules start beside the page, by address."""
    named = (
        str(Path(name).parent / address)
        for name, content in modules.items()
        for address in WORKER.findall(content_bytes(content).decode("utf-8"))
    )
    return sorted(name for name in {*named} if name in modules)


def _join(modules: Mapping[str, Content], entry: str) -> Mapping[str, bytes]:
    packages = installed_packages(PACKAGES)
    with tempfile.TemporaryDirectory() as scratch:
        given, out = Path(scratch).resolve() / "given", Path(scratch).resolve() / "out"
        for name, content in modules.items():
            (given / name).parent.mkdir(parents=True, exist_ok=True)
            (given / name).write_bytes(content_bytes(content))
        places = [str(place) for place in (packages, given, out)]
        run_node([str(DRIVER), *places, entry, *workers_of(modules)], given)
        taken = json.loads((out / "taken.json").read_text(encoding="utf-8"))
        joined = {
            file.relative_to(out).as_posix(): file.read_text(encoding="utf-8")
            for file in sorted(out.rglob("*.js"))
        }
    return {JOINED: json.dumps([joined, taken]).encode()}
