"""The first build of a fresh machine without a network: nothing is cached, nothing can be had."""

import os
import subprocess
from pathlib import Path

import pytest
from support.engine import Engine
from support.places import GERMAN_BOOK

REFUSED = "http://127.0.0.1:9"
"""A proxy at a port where nobody listens: every connection is refused at once."""
LAST = "<!DOCTYPE html><title>The last good site</title>"


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Home and caches of someone who has built this book elsewhere, and has the site of it."""
    folder = tmp_path_factory.mktemp("machine")
    for name in ("home", "cache", "work/site"):
        (folder / name).mkdir(parents=True)
    (folder / "work" / "site" / "index.html").write_text(LAST, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def said(engine: Engine, machine: Path) -> str:
    """What ``make serve`` says until it says where the book is to be seen."""
    proxies = {name: REFUSED for kind in ("http", "https", "all") for name in names(kind)}
    own = {"HOME": machine / "home", "XDG_CACHE_HOME": machine / "cache"}
    settings = {name: str(place) for name, place in own.items()}
    command = [engine.python, "-m", "site_builder", "serve", "--port", "0"]
    with subprocess.Popen(
        [*command, "--out", str(machine / "work" / "site")], cwd=GERMAN_BOOK, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        env={**os.environ, **proxies, **settings, "NO_PROXY": "", "no_proxy": ""},
    ) as serving:  # fmt: skip
        assert serving.stdout
        lines = []
        for line in serving.stdout:
            lines.append(line)
            if line.startswith("http://localhost"):
                break
        serving.terminate()
    return "".join(lines)


def names(kind: str) -> tuple[str, str]:
    """Under which programs look for a proxy."""
    return f"{kind}_proxy", f"{kind}_PROXY".upper()


def test_it_says_what_to_do_and_leaves_the_last_good_site_and_nothing_half_done(
    machine: Path, said: str
) -> None:
    assert "Connect to the internet once: it is kept and never requested again." in said
    assert said.count("cannot get Temml from npm") == 1
    assert "Traceback" not in said
    work = [path.relative_to(machine) for path in (machine / "work").rglob("*")]
    assert sorted(map(str, work)) == ["work/site", "work/site/index.html"]
    assert (machine / "work" / "site" / "index.html").read_text(encoding="utf-8") == LAST
    kept = [path for path in (machine / "cache").rglob("*") if path.is_file()]
    assert not [path for path in kept if "partial" in path.name or "runtime" in path.parts]
