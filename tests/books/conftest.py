"""The book on waves, built once for all workers."""

import json
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock
from support.waves import on_waves


@pytest.fixture(scope="session")
def waves_site(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    own = tmp_path_factory.getbasetemp()
    out = (own if worker_id == "master" else own.parent) / "waves" / "site"
    with FileLock(f"{out.parent}.lock"):
        if not out.exists():
            build = on_waves("-m", "site_builder", "build", "--out", str(out))
            assert build.returncode == 0, build.stderr
            assert "warning" not in build.stderr
    return out


@pytest.fixture(scope="session")
def waves_book(waves_site: Path) -> Any:
    return json.loads((waves_site / "book.json").read_text(encoding="utf-8"))
