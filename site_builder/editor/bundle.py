"""The code editor as one file."""

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

from site_builder.cache.results import cached_result
from site_builder.files.folders import file_hash
from site_builder.programs.node import Package, installed_packages, run_node

HERE = Path(__file__).parent
INGREDIENTS = ("package.json", "package-lock.json", "bundle.mjs", "code_editor.ts")


@dataclass(frozen=True, slots=True)
class EditorBundle:
    """The code editor; without a script where it could not be made."""

    script: bytes = b""
    packages: tuple[Package, ...] = ()


def bundle_editor() -> EditorBundle:
    """Raises `NodeError` where its packages cannot be had."""
    return cached_result("editor", [file_hash(HERE / name) for name in INGREDIENTS], _bundle)


def _bundle() -> EditorBundle:
    with tempfile.TemporaryDirectory() as out:
        run_node([str(HERE / "bundle.mjs"), str(installed_packages(HERE)), out], HERE)
        script = (Path(out) / "code_editor.js").read_bytes()
        packages = json.loads((Path(out) / "packages.json").read_bytes())
    return EditorBundle(script, tuple(Package(**item) for item in packages))
