"""The worker that builds, one that stands by, and what becomes of a build that is overtaken."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from site_builder.book_root import ENGINE, VARIABLE
from site_builder.serving.worker import command

GRACE_S = 0.7
"""How long a build may still go on once its sources have changed: most are done by then."""

type Report = Callable[[Mapping[str, Any]], None]


@dataclass(slots=True)
class Worker:
    """A process that builds when it is told to."""

    process: subprocess.Popen[str]

    def tell(self, changed: Sequence[str]) -> None:
        assert self.process.stdin is not None
        with suppress(BrokenPipeError):
            self.process.stdin.write(command(changed))
            self.process.stdin.flush()

    def end(self) -> None:
        """With all that it has started."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


@dataclass(slots=True)
class Workshop:
    """Builds one after the other, always of the sources as they are now."""

    root: Path
    out: Path
    runtime: bool
    report: Report
    """Told what each build came to, from a thread."""
    clock: Callable[[], float] = time.monotonic
    _worker: Worker | None = None
    _spare: Worker | None = None
    _busy: bool = False
    _wanted_since: float | None = None
    """When a build was asked for while one was running."""
    _lock: threading.RLock = field(default_factory=threading.RLock)

    def build(self, changed: Sequence[str] = ()) -> None:
        """Build, as soon as the present build is done or has outlived its grace. ``changed`` are
        files of code: what is running had them as they were, and is ended at once."""
        with self._lock:
            if changed and self._busy:
                self._replace()
            if self._busy:
                self._wanted_since = self._wanted_since or self.clock()
            else:
                self._begin(changed)

    def tick(self) -> None:
        """To be called every now and then: ends a build that has been overtaken."""
        with self._lock:
            since = self._wanted_since
            if self._busy and since is not None and self.clock() - since > GRACE_S:
                self._replace()
                self._begin()

    def close(self) -> None:
        with self._lock:
            for worker in (self._worker, self._spare):
                if worker:
                    worker.end()
            self._worker = self._spare = None

    def _begin(self, changed: Sequence[str] = ()) -> None:
        self._wanted_since, self._busy = None, True
        if self._worker is None:
            self._worker, self._spare = self._spare or self._start(), None
            threading.Thread(target=self._listen, args=(self._worker,), daemon=True).start()
        self._worker.tell(changed)

    def _replace(self) -> None:
        if self._worker is not None:
            self._worker.end()
        self._worker, self._busy = None, False

    def _start(self) -> Worker:
        command = [sys.executable, "-m", "site_builder.serving.worker", str(self.root)]
        process = subprocess.Popen(
            [*command, str(self.out.resolve()), *([] if self.runtime else ["--no-runtime"])],
            cwd=ENGINE, env={**os.environ, VARIABLE: str(self.root)}, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True,
        )  # fmt: skip
        return Worker(process)

    def _listen(self, worker: Worker) -> None:
        assert worker.process.stdout is not None
        for line in worker.process.stdout:
            self._done(worker, json.loads(line))
        self._done(worker, {"mistakes": "the build ended without a word; see the terminal"})

    def _done(self, worker: Worker, told: Mapping[str, Any]) -> None:
        with self._lock:
            if worker is not self._worker:
                return
            if told.get("afresh"):
                self._replace()
                self._begin()
                return
            self._busy = False
            if worker.process.poll() is not None:
                self._worker = None
            if self._wanted_since is not None:
                self._begin()
            elif self._spare is None:
                self._spare = self._start()
        self.report(told)
