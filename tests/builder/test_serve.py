"""The development server: right types, right errors, news of builds."""

import _thread
import socket
import subprocess
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest

from site_builder.serve import Builds, rebuild, serve, start_server


@pytest.fixture
def builds() -> Builds:
    return Builds()


@pytest.fixture
def address(tmp_path: Path, builds: Builds) -> Iterator[str]:
    for name in ("a.mjs", "a.wasm", "a.zip", "404.html", "book.json", "a.woff2"):
        (tmp_path / name).write_text(f"<p>{name}</p>")
    server = start_server(tmp_path, 0, builds)
    yield f"http://localhost:{server.server_address[1]}"
    server.shutdown()
    server.server_close()


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("a.mjs", "text/javascript"),
        ("a.wasm", "application/wasm"),
        ("a.zip", "application/zip"),
        ("a.woff2", "font/woff2"),
        ("book.json", "application/json"),
    ],
)
def test_files_are_sent_with_the_type_that_browsers_insist_on(
    address: str, name: str, kind: str
) -> None:
    with urllib.request.urlopen(f"{address}/{name}") as reply:
        assert reply.headers["Content-Type"] == kind


def test_an_unknown_address_gets_the_book_s_own_page(address: str) -> None:
    with pytest.raises(urllib.error.HTTPError) as raised:
        urllib.request.urlopen(f"{address}/nothing/here")
    with raised.value as reply:
        assert (reply.code, reply.read()) == (404, b"<p>404.html</p>")


def test_a_page_is_told_of_the_next_build(address: str, builds: Builds) -> None:
    with urllib.request.urlopen(f"{address}/.reload/events", timeout=5) as stream:
        assert stream.readline() == b": \n"
        builds.finish("")
        lines = [stream.readline() for _ in range(3)]
    assert lines == [b"\n", b"event: built\n", b"data: 1\n"]


def test_what_is_saved_during_the_first_build_makes_a_second(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    chapter = tmp_path / "content" / "00-first.md"
    chapter.parent.mkdir()

    def rebuild(_root: Path, _out: Path, builds: Builds, *, runtime: bool) -> None:
        assert not runtime
        builds.finish("")
        rebuilt.append(builds.count)
        if builds.count == 2:
            raise KeyboardInterrupt
        chapter.write_text("Saved meanwhile.")

    rebuilt: list[int] = []
    monkeypatch.setattr("site_builder.serve.rebuild", rebuild)
    watchdog = threading.Timer(20.0, _thread.interrupt_main)
    watchdog.start()
    serve(tmp_path, tmp_path / "site", 0, runtime=False)
    watchdog.cancel()
    assert rebuilt == [1, 2]


@pytest.mark.parametrize(
    ("code", "printed", "event"),
    [
        (0, ("site: 9 files\n", ""), "event: built\ndata: 1\n\n"),
        (1, ("", "a.md:1: bad\n"), 'event: failed\ndata: "a.md:1: bad\\n"\n\n'),
        (-9, ("", ""), 'event: failed\ndata: "the build failed"\n\n'),
    ],
    ids=["good", "bad", "killed"],
)
def test_a_rebuild_tells_what_the_build_said(
    tmp_path: Path,
    builds: Builds,
    monkeypatch: pytest.MonkeyPatch,
    code: int,
    printed: tuple[str, str],
    event: str,
) -> None:
    def build(command: list[str], **_options: object) -> subprocess.CompletedProcess[str]:
        assert command[-1] == "--no-runtime"
        return subprocess.CompletedProcess(command, code, *printed)

    monkeypatch.setattr(subprocess, "run", build)
    rebuild(tmp_path, tmp_path / "site", builds, runtime=False)
    assert builds.event() == event


def test_a_port_in_use_is_named(tmp_path: Path, builds: Builds) -> None:
    with socket.socket() as other:
        other.bind(("", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(OSError, match=f"port {port} is taken or refused; try .*={port + 1}"):
            start_server(tmp_path, port, builds)


def test_a_number_that_is_no_port_is_named(tmp_path: Path, builds: Builds) -> None:
    with pytest.raises(OSError, match="port 99999 is taken or refused; try another: PORT=8000"):
        start_server(tmp_path, 99999, builds)


def test_before_the_first_good_build_the_page_waits_for_one(tmp_path: Path) -> None:
    builds = Builds(mistakes="content/a.md:1: bad")
    server = start_server(tmp_path / "none", 0, builds)
    try:
        with pytest.raises(urllib.error.HTTPError) as raised:
            urllib.request.urlopen(f"http://localhost:{server.server_address[1]}/")
        with raised.value as reply:
            assert reply.code == 503
            assert b"/.reload/client.js" in reply.read()
    finally:
        server.shutdown()
        server.server_close()


def test_open_pages_hear_of_good_and_of_bad_builds() -> None:
    builds = Builds()
    builds.finish("")
    assert builds.event() == "event: built\ndata: 1\n\n"
    builds.finish('content/a.md:1: "bad"\nmore')
    assert builds.event() == 'event: failed\ndata: "content/a.md:1: \\"bad\\"\\nmore"\n\n'
    builds.finish("")
    assert builds.event() == "event: built\ndata: 2\n\n"
