"""The German book, built once for all workers."""

import json
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import pytest
from support.engine import Engine, built_once
from support.places import GERMAN_BOOK


@pytest.fixture(scope="session")
def site(engine: Engine, tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    def build(out: Path) -> CompletedProcess[str]:
        done = engine.run(GERMAN_BOOK, "-m", "site_builder", "build", "--out", str(out))
        assert "warning" not in done.stderr
        return done

    return built_once(tmp_path_factory, worker_id, "german", build)


@pytest.fixture(scope="session")
def german_book(site: Path) -> Any:
    return json.loads((site / "book.json").read_text(encoding="utf-8"))
