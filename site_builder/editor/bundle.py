"""The code editor as one file, made once on each machine and kept."""

import json
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from platformdirs import user_cache_path

from site_builder.editor.npm import HERE, NodeError, install_packages, run_node
from site_builder.runtime.store import put, sha256

INGREDIENTS = ("package.json", "package-lock.json", "bundle.mjs", "code_editor.js")
PRODUCTS = ("code_editor.js", "packages.json")


class EditorBundleError(RuntimeError):
    """The editor's packages could not be had, or not be joined."""


@dataclass(frozen=True, slots=True)
class Package:
    """A package whose code is in the bundle."""

    name: str
    version: str
    license: str
    """Short name."""
    text: str
    """The licence in full."""


@dataclass(frozen=True, slots=True)
class EditorBundle:
    """The code editor; without a script where it could not be made."""

    script: bytes = b""
    packages: tuple[Package, ...] = ()


def bundle_editor(kept: Path | None = None) -> EditorBundle:
    """The code editor, from the folder ``kept`` where it was made before.

    Raises
    ------
    EditorBundleError
        Where it is not kept and the packages cannot be had. The message has npm's own words.
    """
    folder = kept or user_cache_path("image-formation", appauthor=False) / "editor"
    recipe = sha256(b"\0".join((HERE / name).read_bytes() for name in INGREDIENTS))
    record = folder / f"{recipe}.json"
    found = _recall(record, folder)
    if not found:
        found = _make()
        hashes = {name: put(folder, name, data).parent.name for name, data in found.items()}
        record.write_text(json.dumps(hashes), encoding="utf-8")
    packages = json.loads(found["packages.json"])
    return EditorBundle(found["code_editor.js"], tuple(Package(**item) for item in packages))


def _make() -> Mapping[str, bytes]:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        try:
            install_packages(HERE, folder)
        except NodeError as error:
            raise EditorBundleError(f"its packages could not be had from npm: {error}") from None
        for name in ("bundle.mjs", "code_editor.js"):
            shutil.copyfile(HERE / name, folder / name)
        try:
            run_node(["bundle.mjs"], folder)
        except NodeError as error:
            raise EditorBundleError(f"it could not be bundled: {error}") from None
        return {name: (folder / "out" / name).read_bytes() for name in PRODUCTS}


def _recall(record: Path, folder: Path) -> Mapping[str, bytes]:
    """What was kept, where all of it is intact; else nothing."""
    try:
        hashes: dict[str, str] = json.loads(record.read_text(encoding="utf-8"))
        found = {name: (folder / sha / name).read_bytes() for name, sha in hashes.items()}
    except (OSError, ValueError):
        return {}
    intact = all(sha256(found[name]) == sha for name, sha in hashes.items())
    return found if intact and set(found) == set(PRODUCTS) else {}
