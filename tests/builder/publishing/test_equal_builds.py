"""The same book on two machines that differ in whatever they may: the same bytes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.little_book import files_of

ROOT = Path(__file__).resolve().parents[3]
ONE = {"TZ": "UTC", "LC_ALL": "C.UTF-8", "PYTHONHASHSEED": "1"}
OTHER = {"TZ": "Pacific/Auckland", "LC_ALL": "C", "PYTHONHASHSEED": "77"}
PLAIN = "import sys; from pathlib import Path; from site_builder.build import build_site; "
PLAIN += "build_site(Path(sys.argv[1]), Path(sys.argv[2]), runtime=False)"


def write_book(root: Path, *, reverse: bool = False) -> None:
    files = files_of("equal")
    for name in sorted(files, reverse=reverse):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(files[name], encoding="utf-8")


def build(how: list[str], folder: Path, settings: dict[str, str], umask: int) -> dict[str, bytes]:
    command = [sys.executable, *how, str(folder), str(folder / "site")]
    environment = {**os.environ, **settings, "PYTHONPATH": str(ROOT)}
    subprocess.run(command, env=environment, umask=umask, check=True, cwd=folder)
    files = (file for file in (folder / "site").rglob("*") if file.is_file())
    return {file.relative_to(folder).as_posix(): file.read_bytes() for file in files}


@pytest.mark.deep
def test_two_machines_build_the_same_bytes(tmp_path: Path) -> None:
    one, other = tmp_path / "one", tmp_path / "an öther" / "place"
    write_book(one)
    write_book(other, reverse=True)
    first = build(["-c", PLAIN], one, ONE, 0o022)
    second = build([str(ROOT / "tests/support/odd_machine.py")], other, OTHER, 0o077)
    assert {"sitemap.xml", "feed.xml", "card.png"} <= {name.removeprefix("site/") for name in first}
    assert sorted(first) == sorted(second)
    assert [name for name in first if first[name] != second[name]] == []
