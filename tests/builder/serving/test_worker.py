"""A worker goes on with code that has changed, and what it builds is what a fresh one builds."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from support.waves import ROOT, WAVES

from site_builder.book_root import VARIABLE
from site_builder.forking import CAN_FORK
from site_builder.serving.worker import AFRESH, command

pytestmark = pytest.mark.skipif(not CAN_FORK, reason="this system cannot fork")
SCENE = "simulations/scenes/wave_packet/scene.py"
MODEL = "simulations/models/dispersion.py"
PAGE = "beats/index.html"
LATER = "search/index.json"
"""Made after the answer."""


@dataclass(frozen=True, slots=True)
class Served:
    """A worker, and the book that it builds."""

    book: Path
    out: Path
    process: "subprocess.Popen[str]"

    def build(self, *changed: str) -> dict[str, Any]:
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(command([str(self.book / path) for path in changed]))
        self.process.stdin.flush()
        answer: dict[str, Any] = json.loads(self.process.stdout.readline())
        return answer

    def edit(self, path: str, old: str, new: str) -> None:
        file = self.book / path
        text = file.read_text(encoding="utf-8")
        assert old in text
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def page(self) -> str:
        return (self.out / PAGE).read_text(encoding="utf-8")

    def files(self) -> dict[str, bytes]:
        places = {str(file.relative_to(self.out)): file for file in self.out.rglob("*")}
        return {name: file.read_bytes() for name, file in places.items() if file.is_file()}


def begun(book: Path, out: Path) -> Served:
    process = subprocess.Popen(
        [sys.executable, "-m", "site_builder.serving.worker", str(book), str(out), "--no-runtime"],
        cwd=ROOT, env={**os.environ, VARIABLE: str(book)}, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    )  # fmt: skip
    return Served(book, out, process)


def ended(served: Served) -> int:
    with served.process as process:
        assert process.stdin is not None
        process.stdin.close()
        return process.wait(30)


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    shutil.copytree(WAVES, tmp_path / "book")
    found = begun(tmp_path / "book", tmp_path / "site")
    assert not found.build()["mistakes"]
    yield found
    assert ended(found) == 0


def test_what_is_built_after_edits_of_code_is_what_a_fresh_worker_builds(served: Served) -> None:
    # As long as before and in the same second: Python's own byte code would not know.
    served.edit(SCENE, "Beat over crest", "Beat upon crest")
    assert PAGE in served.build(SCENE)["changed"]
    assert "Beat upon crest" in served.page()
    served.edit(SCENE, "Beat upon crest", "Beat under it")
    served.edit(SCENE, "Beat under it", "Beat below it ")
    served.build(SCENE)
    assert "Beat below it " in served.page()
    served.edit("content/02-beats.md", "Throw a stone", "Cast a stone")
    served.build()
    assert "Cast a stone" in served.page()
    served.edit(MODEL, "9.81", "3.71")
    served.build(MODEL)
    assert "Beat below it " in served.page()
    fresh = begun(served.book, served.out.with_name("fresh"))
    assert not fresh.build()["mistakes"]
    ended(fresh)
    there = {name: data for name, data in served.files().items() if name != LATER}
    assert there == {name: data for name, data in fresh.files().items() if name != LATER}


def test_a_mistake_in_changed_code_is_told_and_mended(served: Served) -> None:
    served.edit(SCENE, "SCENE = ", "SCENE = 1 / 0, ")
    assert "division by zero" in served.build(SCENE)["mistakes"]
    served.edit(SCENE, "SCENE = 1 / 0, ", "SCENE = ")
    assert not served.build(SCENE)["mistakes"]


def test_what_the_builder_itself_imports_and_what_is_new_asks_for_a_fresh_one(
    served: Served,
) -> None:
    assert served.build("simulations/scenes/new.py") == AFRESH
    assert served.build(f"{ROOT}/site_builder/build.py") == AFRESH


def test_a_worker_whose_copy_is_lost_ends_so_that_another_takes_its_place(served: Served) -> None:
    served.edit(
        SCENE, "SCENE = ", "import os, signal\nos.kill(os.getpid(), signal.SIGKILL)\nSCENE = "
    )
    assert served.process.stdin is not None
    assert served.process.stdout is not None
    served.process.stdin.write(command([str(served.book / SCENE)]))
    served.process.stdin.flush()
    assert not served.process.stdout.readline()
    assert served.process.wait(30) == 0
