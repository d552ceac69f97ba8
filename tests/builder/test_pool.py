"""The pool of processes for authors' code: time limits, errors with their lines, output, and copies
of objects."""

import os
import runpy
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from support.little_book import PACKAGE, small_package
from support.places import ROOT

from simulations.engine.settings import values_of
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.diagnostics.blame import place_of
from site_builder.pool.loading import copy_of
from site_builder.pool.processes import KilledError, run_in_pool, side_by_side, using_pool

MODULE = f"{PACKAGE}.scene"
SECONDS = 2.0


@pytest.fixture(scope="module", autouse=True)
def pool() -> Iterator[None]:
    with using_pool():
        yield


def test_processes_end_with_their_pool() -> None:
    with using_pool():
        process = run_in_pool(os.getpid)
        assert process != os.getpid()
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


ENDLESS = [
    ("while True: pass", "takes more than 2 s"),
    ("time.sleep(60)", "takes more than 2 s"),
    ("sum(itertools.repeat(1))", "takes more than 2 s"),
    ("os._exit(0)", "ends its process, exit code 1"),
    ("os._exit(3)", "ends its process, exit code 3"),
    ("ctypes.string_at(0)", "ends its process, SIGSEGV"),
    ("os.abort()", "ends its process, SIGABRT"),
]


@pytest.mark.parametrize(("line", "says"), ENDLESS)
def test_endless_job_is_killed_and_its_line_is_named(line: str, says: str, tmp_path: Path) -> None:
    source = f"import ctypes, itertools, os, time\n\ndef draw():\n    {line}\n\ndraw()\n"
    place, who = "simulations/small/scene.py", "the-scene"
    with using_pool(SECONDS), small_package(tmp_path / "böok", {"scene": source}):
        for job in (partial(runpy.run_path, str(tmp_path / "böok" / place)), os.getpid):
            with pytest.raises(KilledError) as raised:
                run_in_pool(job, of=who)  # which is not tried again
            assert (place_of(raised.value), str(raised.value)) == (f"{place}:4", f"{who!r} {says}")
        assert run_in_pool(partial(divmod, 7, 4)) == (1, 3)


class AwkwardError(Exception):
    """An exception that cannot be restored from its message."""

    def __init__(self, one: int, two: int) -> None:
        super().__init__(f"{one} and {two}")


def fail_awkwardly() -> None:
    raise AwkwardError(1, 2)


class SilentError(AwkwardError):
    """An exception without a text."""

    def __str__(self) -> str:
        sys.exit("no words")


def fail_silently() -> None:
    raise SilentError(1, 2)


FAILURES: list[tuple[Callable[[], object], type[Exception], str]] = [
    (partial(signal.raise_signal, signal.SIGKILL), KilledError, "ends its process, SIGKILL"),
    (partial(signal.raise_signal, 35), KilledError, "ends its process, exit code -35"),
    (partial(sys.exit, 2), RuntimeError, "SystemExit: 2"),
    (partial(divmod, 1, 0), ZeroDivisionError, "zero"),
    (fail_awkwardly, RuntimeError, "AwkwardError: 1 and 2"),
    (fail_silently, RuntimeError, r"SilentError: <exception str\(\) failed>"),
    (lambda: 1, TypeError, "legal: data and functions of modules"),
]


@pytest.mark.parametrize(("job", "error", "words"), FAILURES)
def test_exception_of_a_job_is_raised_and_the_next_job_runs(
    job: Callable[[], object], error: type[Exception], words: str
) -> None:
    with pytest.raises(error, match=words):
        run_in_pool(job)
    assert run_in_pool(partial(divmod, 7, 4)) == (1, 3)


def test_output_of_a_job_is_shown_beside_the_output_of_the_command() -> None:
    script = """
import os
from functools import partial
from site_builder.pool.processes import run_in_pool, using_pool
with using_pool():
    run_in_pool(partial(print, "from Python"))
    run_in_pool(partial(os.write, 1, b"from a library"))
"""
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert (done.stdout, done.stderr) == ("", "from Python\nfrom a library")


SCENE = """
from dataclasses import dataclass
from simulations.engine.scene import Scene
from simulations.engine.settings import slider

@dataclass(frozen=True, slots=True)
class Settings:
    depth: float = slider("Depth", 5.0, 0, 10, 0.5)

SCENE = Scene("scene", "A scene", Settings, lambda settings, outputs: 1 / 0)
"""


def attribute(module: str, name: str) -> Any:
    __import__(module)
    return getattr(sys.modules[module], name)


def test_scene_is_copied_without_importing_its_module(tmp_path: Path) -> None:
    with small_package(tmp_path, {"scene": SCENE}), using_pool():
        scene = copy_of(MODULE, partial(attribute, MODULE, "SCENE"))
        assert MODULE not in sys.modules
    assert scene.check({"depth": 2.5}).depth == 2.5


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_copy_of_a_scene_has_all_fields_that_the_builder_reads(scene_id: str) -> None:
    scene = load_scene(scene_id)
    copy = copy_of(SCENE_MODULES[scene_id], partial(load_scene, scene_id))
    assert copy.controls == scene.controls
    assert values_of(copy.check({})) == values_of(scene.check({}))
    assert copy.title == scene.title
    for name in ("names", "default", "ladder"):
        assert getattr(copy.accuracy, name) == getattr(scene.accuracy, name)
    for name in ("photograph", "measures_photographs"):
        assert getattr(copy.instrument, name) == getattr(scene.instrument, name)
    assert [each.drives for each in copy.handles] == [each.drives for each in scene.handles]


MODEL = """
from typing import NamedTuple

class Lens(NamedTuple):
    focal_mm: float

class Camera:
    def __init__(self, lens):
        self.lens = lens

def focal(camera):
    return camera.lens.focal_mm
"""


def test_objects_of_authors_are_used_without_importing_their_module(tmp_path: Path) -> None:
    with small_package(tmp_path, {"scene": MODEL}), using_pool():
        lens, camera, focal = (
            run_in_pool(partial(attribute, MODULE, name)) for name in ("Lens", "Camera", "focal")
        )
        made = camera(lens(focal_mm=35.0))
        assert (focal(made), made.lens.focal_mm) == (35.0, 35.0)
        with pytest.raises(AttributeError, match="lense"):
            made.lense  # noqa: B018
        assert MODULE not in sys.modules


def test_parallel_jobs_return_their_results_in_order() -> None:
    jobs = [partial(run_in_pool, partial(divmod, number, 4)) for number in range(9)]
    assert [done.result() for done in side_by_side(jobs)] == [divmod(n, 4) for n in range(9)]
