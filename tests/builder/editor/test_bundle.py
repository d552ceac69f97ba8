"""The code editor: bundled from pinned packages, kept, and done without where it cannot be had."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from site_builder.assets import browser_parts
from site_builder.assets import python as browser_python
from site_builder.build import Options, render_site
from site_builder.diagnostics.diagnostic import Diagnostic
from site_builder.editor.bundle import HERE, EditorBundle
from site_builder.files.engine import ENGINE
from site_builder.pages.licences import gather_licences
from site_builder.programs import node as npm
from site_builder.programs.node import NodeError, Package, installed_packages, run_node
from site_builder.runtime.pack import RuntimeBundle
from site_builder.runtime.pinned import VERSIONS

LOCKS = sorted((ENGINE / "site_builder").rglob("package-lock.json"))
PAGE = "::::{simulation} demo\nText.\n::::\n"


@pytest.mark.parametrize("lock", LOCKS, ids=lambda file: file.parent.name)
def test_every_package_is_pinned_by_a_hash_and_the_lock_names_no_address(lock: Path) -> None:
    locked = json.loads(lock.read_text(encoding="utf-8"))["packages"]
    packages = [item for name, item in locked.items() if name]
    assert all(item["integrity"].startswith("sha512-") for item in packages)
    assert not any("resolved" in item for item in packages)


def test_what_a_program_under_node_complains_is_told(tmp_path: Path) -> None:
    (tmp_path / "fails.mjs").write_text("console.error('npm error no way'); process.exit(3)")
    with pytest.raises(NodeError, match=r"^no way$"):
        run_node(["fails.mjs"], tmp_path)


def test_without_the_editor_the_book_is_built_and_says_so(
    make_book: Callable[..., Options], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse() -> EditorBundle:
        raise NodeError("no network")

    monkeypatch.setattr(browser_parts, "bundle_editor", refuse)
    bare = RuntimeBundle({}, VERSIONS)
    monkeypatch.setattr(browser_python, "pack_runtime", lambda _root, **_shown: bare)
    warnings: list[Diagnostic] = []
    files = render_site(replace(make_book(PAGE), runtime=True, warn=warnings.append))
    page = files["first/index.html"]
    assert isinstance(page, bytes)
    assert b'class="open-python"' in page
    assert b"data-editor" not in page
    assert any(name.endswith("python/demo.json") for name in files)
    (told,) = [str(item) for item in warnings if "editor" in item.path]
    assert "warning: the figures' Python can be read but not edited" in told
    assert "no network" in told


def test_packages_are_installed_once_and_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def install(_lock: Path, target: Path) -> None:
        (target / "node_modules" / "esbuild").mkdir(parents=True)

    monkeypatch.setattr(npm, "install_packages", install)
    folder = installed_packages(HERE, tmp_path)
    assert (folder / "node_modules" / "esbuild").is_dir()
    monkeypatch.delattr(npm, "install_packages")
    assert installed_packages(HERE, tmp_path) == folder
    assert [*tmp_path.iterdir()] == [folder], "nothing else is left behind"


def test_a_licence_that_several_packages_share_is_shown_once_below_their_names() -> None:
    packages = [
        Package("a", "1.0", "MIT", "One text.\n"),
        Package("b", "2.0", "MIT", "One text."),
        Package("c", "3.0", "ISC", "Another."),
    ]
    (entry,) = (
        item
        for item in gather_licences(Path(), VERSIONS, packages)
        if item.part.startswith("CodeMirror")
    )
    assert entry.name == "ISC and MIT"
    assert entry.text == "a 1.0, b 2.0\n\nOne text.\n\n\nc 3.0\n\nAnother."
