"""A site that all workers test, built by the first that asks for it."""

from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from filelock import FileLock


def built_once(
    folders: pytest.TempPathFactory,
    worker_id: str,
    name: str,
    build: Callable[[Path], CompletedProcess[str]],
) -> Path:
    """The folder that ``build`` writes; what it says, where that fails, fails the test."""
    own = folders.getbasetemp()
    out = (own if worker_id == "master" else own.parent) / name / "site"
    with FileLock(f"{out.parent}.lock"):
        if not out.exists():
            done = build(out)
            assert done.returncode == 0, done.stderr
    return out
