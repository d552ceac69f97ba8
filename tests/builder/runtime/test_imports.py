"""What the simulations import, read from their sources; and whether running them agrees."""

import subprocess
import sys
from pathlib import Path

import pytest

from simulations.registry import SCENE_MODULES
from site_builder.runtime.imports import Table, outside, reach, read_imports

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def table(imports_of_the_book: Table) -> Table:
    return imports_of_the_book


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "toy"
    (folder / "models").mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "scene.py").write_text("import math\nfrom toy.models import lens\n")
    (folder / "other.py").write_text("import json\n")
    (folder / "models" / "__init__.py").write_text("")
    (folder / "models" / "lens.py").write_text(
        "from collections.abc import Sequence\n"
        "import numpy as np\n"
        "def noise(): return np.random.default_rng(np.pi)\n"
        "def late():\n    import statistics\n"
    )
    return folder


def test_a_module_reaches_what_it_imports_however_indirectly(package: Path) -> None:
    table = read_imports(package)
    assert reach(table, "toy.scene") == {"toy", "toy.scene", "toy.models", "toy.models.lens"}


def test_imports_from_outside_are_found_with_their_place(package: Path) -> None:
    table = read_imports(package)
    found = outside(table, reach(table, "toy.scene"))
    assert found == {
        "math": "toy/scene.py:1",
        "collections.abc": "toy/models/lens.py:1",
        "numpy": "toy/models/lens.py:2",
        "numpy.random": "toy/models/lens.py:3",
        "statistics": "toy/models/lens.py:5",
    }


def test_a_package_that_is_not_installed_here_is_found_too(package: Path) -> None:
    (package / "other.py").write_text("import no_such_package\n")
    assert outside(read_imports(package), ["toy.other"]) == {"no_such_package": "toy/other.py:1"}


RENDER = "from simulations.browser import render; render('figure', sys.argv[1], '{}', '')"
TELL = "print(*(name for name, one in sys.modules.items() if getattr(one, '__file__', '')))"
SAMPLE = ("aliasing", "jpeg", "photon-transfer")
"""Of them two import parts of numpy that others do without."""


def imported_by(code: str, *given: str) -> set[str]:
    """All modules that have a file, once that was run."""
    command = [sys.executable, "-c", f"import sys; {code}; {TELL}", *given]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.fixture(scope="module")
def with_numpy() -> set[str]:
    """What is imported along with it."""
    return imported_by("import numpy, numpy.typing")


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(scene, marks=[] if scene in SAMPLE else pytest.mark.deep)
        for scene in SCENE_MODULES
    ],
)
def test_rendering_a_scene_imports_nothing_beyond_what_its_sources_tell(
    scene: str, table: Table, with_numpy: set[str]
) -> None:
    imported = imported_by(RENDER, scene)
    known = reach(table, "simulations.browser") | reach(table, SCENE_MODULES[scene])
    assert {name for name in imported if name.startswith("simulations.")} <= known
    numpy = [name for name in imported if name.startswith("numpy.")]
    parts = {".".join(name.split(".")[:2]) for name in numpy}
    assert parts <= with_numpy | set(outside(table, known))
