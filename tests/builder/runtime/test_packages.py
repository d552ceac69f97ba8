"""Packages of Pyodide's release that a book asks for."""

import json
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from support.little_book import OUTLINE

from site_builder.build import Options, render_site
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.programs.node import Package
from site_builder.runtime import packages
from site_builder.runtime.pack import pack_runtime
from site_builder.runtime.packages import PackageError, differing, needed, read_package

LISTED = {
    "numpy": {"package_type": "package", "depends": []},
    "lens": {"package_type": "package", "depends": ["numpy", "glass"]},
    "glass": {"package_type": "package", "depends": []},
    "atlas": {"package_type": "package", "depends": ["libgeos"]},
    "libgeos": {"package_type": "shared_library", "depends": []},
}


def test_what_a_package_needs_comes_with_it_but_numpy_is_there() -> None:
    assert needed(["lens"], LISTED) == ["glass", "lens"]


@pytest.mark.parametrize(
    ("name", "message"), [("lense", "did you mean 'lens'"), ("atlas", "'libgeos' is a shared")]
)
def test_packages_that_cannot_be_had_are_refused(name: str, message: str) -> None:
    with pytest.raises(PackageError, match=message):
        needed([name], LISTED)


def test_a_wheel_tells_its_licences_and_its_page(tmp_path: Path) -> None:
    wheel = tmp_path / "lens-1.0-py3-none-any.whl"
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr("lens.py", "")
        told = (
            "Name: lens",
            "Version: 1.0",
            "License-Expression: MIT",
            "Project-URL: A, https://a.b/c",
        )
        archive.writestr("lens-1.0.dist-info/METADATA", "\n".join(told))
        archive.writestr("lens-1.0.dist-info/licenses/LICENSE", "Permission is granted.")
    expected = Package("lens", "1.0", "MIT", "Permission is granted.", "https://a.b/c")
    assert read_package(wheel) == expected


def test_versions_that_differ_are_told_with_both(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packages, "version", {"lens": "1.1", "glass": "2.0"}.__getitem__)
    found = differing([Package("lens", "1.0", "", ""), Package("glass", "2.0", "", "")])
    assert found == [
        "lens is 1.1 here and 1.0 in the browser; better: the same on both sides, "
        "'lens==1.0' in pyproject.toml"
    ]


SCENE = """\
from dataclasses import dataclass

import six

from simulations.engine.frame import Frame, Panel, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    count: float = slider("Count", 1, 0, 2, 1)


def draw(settings, outputs):
    kind = readout("size", "Size", len(six.string_types), digits=0)
    return Frame((Panel("plan", "Plan", 400, 300),), (kind,), "Shows nothing.")


SCENE = Scene("orbit", "Orbit", Settings, draw)
"""


@pytest.mark.deep
def test_a_scene_gets_the_package_that_it_imports(tmp_path: Path) -> None:
    room = tmp_path / "simulations" / "scenes" / "orbit"
    room.mkdir(parents=True)
    (room / "__init__.py").touch()
    (room / "scene.py").write_text(SCENE, encoding="utf-8")
    scenes = {"orbit": "simulations.scenes.orbit.scene"}

    folder = tmp_path / "simulations"
    bundle = pack_runtime(folder, None, scenes, {}, compiled=False, packages=["six"])
    assert [package.name for package in bundle.packages] == ["six"]
    table = json.loads(bundle.files["runtime.json"].read_text())
    assert table["scenes"]["orbit"] == ["scene-orbit", "package-six"]
    assert table["modules"]["package-six"] == ["six"]
    with zipfile.ZipFile(bundle.files["package-six.zip"]) as archive:
        assert archive.namelist() == ["six.pyc"]


@pytest.mark.deep
def test_an_unknown_package_is_told_at_its_line(make_book: Callable[..., Options]) -> None:
    outline = OUTLINE + '[runtime]\npackages = ["sixx"]\n'
    page = "::::{simulation} demo\nText.\n::::\n"
    options = make_book(page, {"content/book.toml": outline})
    with pytest.raises(BuildError) as raised:
        render_site(replace(options, runtime=True))
    (found,) = raised.value.diagnostics
    assert isinstance(found, Diagnostic)
    assert str(found).startswith("content/book.toml:6: unknown package 'sixx'; did you mean 'six'?")
