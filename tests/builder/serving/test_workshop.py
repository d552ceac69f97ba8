"""Who builds, and what becomes of a build that is overtaken."""

import json
import queue
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from site_builder.serving.worker import AFRESH, command
from site_builder.serving.workshop import GRACE_S, Workshop

BUILD = command()
SCENE = "simulations/scenes/camera/scene.py"


@dataclass
class Process:
    """A worker whose builds are done when the test says so."""

    told: list[str] = field(default_factory=list)
    answers: "queue.Queue[str]" = field(default_factory=queue.Queue)
    ended: bool = False

    @property
    def stdin(self) -> "Process":
        return self

    @property
    def stdout(self) -> Iterator[str]:
        return iter(self.answers.get, "")

    def write(self, line: str) -> None:
        self.told.append(line)

    def flush(self) -> None:
        pass

    def poll(self) -> int | None:
        return -9 if self.ended else None

    def wait(self) -> None:
        self.ended = True
        self.answers.put("")

    @property
    def pid(self) -> int:
        raise ProcessLookupError  # nobody to send a signal to


@dataclass
class Bench:
    """A workshop on processes of the test's own, with a clock that stands still."""

    shop: Workshop
    processes: list[Process]
    reports: "queue.Queue[Mapping[str, Any]]"
    now: list[float]

    def finish(self, process: Process, said: str) -> Mapping[str, Any]:
        process.answers.put(f'{{"mistakes": "", "said": "{said}"}}\n')
        return self.reports.get(timeout=20)


@pytest.fixture
def bench(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Bench]:
    processes: list[Process] = []

    def start(*_args: object, **_kwargs: object) -> Process:
        processes.append(Process())
        return processes[-1]

    monkeypatch.setattr("site_builder.serving.workshop.subprocess.Popen", start)
    reports: queue.Queue[Mapping[str, Any]] = queue.Queue()
    now = [0.0]
    shop = Workshop(tmp_path, tmp_path / "site", False, reports.put, clock=lambda: now[0])
    yield Bench(shop, processes, reports, now)
    shop.close()


def test_one_worker_builds_again_and_again(bench: Bench) -> None:
    for said in ("one", "two"):
        bench.shop.build()
        assert bench.finish(bench.processes[0], said)["said"] == said
    assert bench.processes[0].told == [BUILD] * 2


def test_a_worker_is_told_what_code_has_changed(bench: Bench) -> None:
    bench.shop.build()
    bench.finish(bench.processes[0], "one")
    bench.shop.build([SCENE])
    assert not bench.processes[0].ended
    assert bench.processes[0].told == [BUILD, command([SCENE])]
    assert bench.finish(bench.processes[0], "two")["said"] == "two"


def test_a_second_stands_by_and_builds_where_the_first_cannot_have_the_changed_code(
    bench: Bench,
) -> None:
    bench.shop.build()
    bench.finish(bench.processes[0], "one")
    assert [process.told for process in bench.processes] == [[BUILD], []]
    bench.shop.build([SCENE])
    bench.processes[0].answers.put(f"{json.dumps(AFRESH)}\n")
    assert bench.finish(bench.processes[1], "two")["said"] == "two"
    assert bench.processes[0].ended
    assert bench.reports.empty()


def test_a_build_whose_code_changes_is_ended_at_once(bench: Bench) -> None:
    bench.shop.build()
    bench.shop.build([SCENE])
    assert bench.processes[0].ended
    assert bench.finish(bench.processes[1], "two")["said"] == "two"


def test_what_changes_during_a_build_is_built_after_it_once(bench: Bench) -> None:
    bench.shop.build()
    bench.shop.build()
    bench.shop.build()
    assert bench.processes[0].told == [BUILD]
    bench.finish(bench.processes[0], "one")
    assert bench.processes[0].told == [BUILD] * 2
    bench.finish(bench.processes[0], "two")
    assert bench.processes[0].told == [BUILD] * 2


def test_a_build_that_outlives_its_grace_is_killed(bench: Bench) -> None:
    bench.shop.build()
    bench.shop.build()
    bench.now[0] = GRACE_S
    bench.shop.tick()
    assert not bench.processes[0].ended
    bench.now[0] = GRACE_S + 0.1
    bench.shop.tick()
    assert bench.processes[0].ended
    assert bench.processes[1].told == [BUILD]
    assert bench.finish(bench.processes[1], "newer")["said"] == "newer"
    assert bench.reports.empty()


def test_a_build_that_nothing_has_overtaken_may_take_its_time(bench: Bench) -> None:
    bench.shop.build()
    bench.now[0] = 1000.0
    bench.shop.tick()
    assert not bench.processes[0].ended


def test_a_worker_that_dies_is_told_of_and_replaced(bench: Bench) -> None:
    bench.shop.build()
    bench.processes[0].wait()
    assert "ended without a word" in bench.reports.get(timeout=20)["mistakes"]
    bench.shop.build()
    assert bench.finish(bench.processes[-1], "again")["said"] == "again"
