"""The code editor as one file, made once on each machine."""

import json
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from platformdirs import user_cache_path

from site_builder.editor.npm import HERE, NodeError, installed_packages, run_node
from site_builder.runtime.store import made_once, sha256

INGREDIENTS = ("package.json", "package-lock.json", "bundle.mjs", "code_editor.ts")
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
    files = made_once(folder, recipe, _make)
    packages = json.loads(files["packages.json"].read_bytes())
    script = files["code_editor.js"].read_bytes()
    return EditorBundle(script, tuple(Package(**item) for item in packages))


def _make() -> Mapping[str, bytes]:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        try:
            packages = installed_packages(HERE) / "node_modules"
        except NodeError as error:
            raise EditorBundleError(f"its packages could not be had from npm: {error}") from None
        (folder / "node_modules").symlink_to(packages, target_is_directory=True)
        for name in ("bundle.mjs", "code_editor.ts"):
            shutil.copyfile(HERE / name, folder / name)
        try:
            run_node(["bundle.mjs"], folder)
        except NodeError as error:
            raise EditorBundleError(f"it could not be bundled: {error}") from None
        return {name: (folder / "out" / name).read_bytes() for name in PRODUCTS}
