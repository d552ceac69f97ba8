"""The snapshot that readers begin with: the same wherever and whenever it is made."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from support.places import WAVES
from support.waves import LADDERS, SCENES

from site_builder.cache.results import Cache, using
from site_builder.runtime import pack
from site_builder.runtime.fetch import fetch_runtime
from site_builder.runtime.freeze import INTERPRETER, FreezeError
from site_builder.runtime.pack import SITE_PACKAGES, RuntimeBundle, pack_runtime
from site_builder.runtime.snapshot import SNAPSHOT, make_snapshot

FETCHED = fetch_runtime()


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RuntimeBundle]:
    """Of the book on waves, which is kept between builds; its byte code until the last test."""
    with using(Cache(tmp_path_factory.mktemp("cache"))):
        yield pack_runtime(WAVES / "simulations", None, SCENES, LADDERS)


def make(bundle: RuntimeBundle, folder: Path, modules: Sequence[str]) -> Path:
    machine = {name: FETCHED[name] for name in INTERPRETER}
    files = bundle.files
    archives = [files["core.zip"]]
    return make_snapshot(machine, files["python.zip"], {}, archives, modules, SITE_PACKAGES, folder)


def test_the_runtime_folder_holds_every_file_that_its_table_names(bundle: RuntimeBundle) -> None:
    table = json.loads(bundle.files["runtime.json"].read_text())
    assert {*table["integrity"], "runtime.json"} == set(bundle.files)
    assert {f"{part}.zip" for part in table["modules"]} <= set(bundle.files)
    wanted = set().union(*table["scenes"].values(), *table["ladders"].values())
    assert {f"{part}.zip" for part in wanted} <= set(table["integrity"])
    assert wanted & set(table["modules"]), "some scene asks for more than numpy's core"


@pytest.mark.deep
def test_it_is_the_same_in_any_folder_time_zone_and_language(
    bundle: RuntimeBundle, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = make(bundle, tmp_path / "a", ["json"]).read_bytes()
    elsewhere = tmp_path / "a folder with a much longer name"
    elsewhere.mkdir()
    monkeypatch.setenv("TMPDIR", str(elsewhere))
    monkeypatch.setattr("tempfile.tempdir", str(elsewhere))
    for name, value in {"TZ": "Asia/Tokyo", "LANG": "de_CH.UTF-8", "PYTHONHASHSEED": "7"}.items():
        monkeypatch.setenv(name, value)
    assert make(bundle, elsewhere / "b", ["json"]).read_bytes() == here


def test_it_is_among_the_files_of_the_runtime_where_these_are_compiled(
    bundle: RuntimeBundle,
) -> None:
    assert bundle.snapshot_error == ""
    assert SNAPSHOT in bundle.files
    plain = pack_runtime(WAVES / "simulations", None, SCENES, LADDERS, compiled=False)
    assert SNAPSHOT not in plain.files, "an author who edits would wait for it"


def test_a_module_that_fails_is_told(bundle: RuntimeBundle, tmp_path: Path) -> None:
    with pytest.raises(FreezeError, match="No module named 'no_such'"):
        make(bundle, tmp_path, ["no_such"])


def test_without_it_the_runtime_is_whole_and_says_why(
    bundle: RuntimeBundle, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_given: object) -> Path:
        raise FreezeError("no room")

    monkeypatch.setattr(pack, "make_snapshot", fails)
    without = pack_runtime(WAVES / "simulations", None, SCENES, LADDERS)
    assert without.snapshot_error == "no room"
    assert {*bundle.files} - {*without.files} == {SNAPSHOT}
