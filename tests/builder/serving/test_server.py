"""The development server: right types, right errors, only its own, news of builds."""

import http.client
import socket
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from functools import partialmethod
from pathlib import Path

import pytest
from support.ranges import ANSWERS, WHOLE

from site_builder.serving.news import News
from site_builder.serving.server import Server, is_own, start_server

FILES = ("a.bin", "a.mjs", "a.wasm", "a.zip", "404.html", "book.json", "a.woff2", "folder/a.css")


@pytest.fixture
def news() -> News:
    return News()


@pytest.fixture
def server(tmp_path: Path, news: News, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    (tmp_path / "outside.txt").write_text("secret")
    out = tmp_path / "site"
    for name in FILES:
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_text(f"<p>{name}</p>")
    (out / "a.bin").write_bytes(WHOLE)
    (out / "link.txt").symlink_to(tmp_path / "outside.txt")
    at_once = partialmethod(Server.serve_forever, poll_interval=0.01)  # notices that it is to end
    monkeypatch.setattr(Server, "serve_forever", at_once)
    server = start_server(out, 0, news)
    yield server
    server.shutdown()
    server.server_close()


@pytest.fixture
def address(server: Server, news: News) -> str:
    news.finish("")
    return f"http://localhost:{server.server_address[1]}"


def status(server: Server, path: str, host: str = "localhost", method: str = "GET") -> int:
    connection = http.client.HTTPConnection("127.0.0.1", server.server_address[1], timeout=20)
    connection.request(method, path, headers={"Host": host})
    reply = connection.getresponse()
    reply.read()
    connection.close()
    return reply.status


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


def part(address: str, **headers: str) -> tuple[int, bytes, str | None, str]:
    """Status, body, place and time of what is asked for with these headers."""
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    request = urllib.request.Request(f"{address}/a.bin", headers=named)
    try:
        reply = urllib.request.urlopen(request)
    except urllib.error.HTTPError as refused:
        reply = refused
    with reply:
        told = reply.headers
        return reply.status, reply.read(), told["Content-Range"], told["Last-Modified"]


@pytest.mark.parametrize("asked", ANSWERS)
def test_a_film_that_is_wound_forward_gets_the_part_that_it_asks_for(
    address: str, asked: str
) -> None:
    assert part(address, Range=asked)[:3] == ANSWERS[asked]


def test_a_part_of_a_file_that_has_changed_since_is_not_sent_for_the_rest_of_the_old(
    address: str,
) -> None:
    *_, changed = part(address)
    assert part(address, Range="bytes=2-4", If_Range=changed)[:2] == (206, b"234")
    before = "Mon, 01 Jan 2024 00:00:00 GMT"
    assert part(address, Range="bytes=2-4", If_Range=before)[:2] == (200, WHOLE)


@pytest.mark.parametrize(
    "path", ["/../outside.txt", "/%2e%2e/outside.txt", "/link.txt", "/folder/"]
)
def test_nothing_outside_the_site_is_sent_and_no_folder_listed(
    server: Server, news: News, path: str
) -> None:
    news.finish("")
    assert status(server, path) == 404


@pytest.mark.parametrize("method", ["GET", "HEAD"])
@pytest.mark.parametrize("path", ["/book.json", "/.reload/events", "/.reload/client.js"])
def test_another_name_than_its_own_is_refused(
    server: Server, news: News, path: str, method: str
) -> None:
    news.finish("")
    assert status(server, path, "evil.example", method) == 421


@pytest.mark.parametrize(
    ("name", "host", "own"),
    [
        ("localhost:8000", "127.0.0.1", True),
        ("LOCALHOST", "127.0.0.1", True),
        ("127.0.0.1:8000", "127.0.0.1", True),
        ("[::1]:8000", "127.0.0.1", True),
        ("", "127.0.0.1", False),
        ("localhost.evil.example", "127.0.0.1", False),
        ("192.168.1.5:8000", "127.0.0.1", False),
        ("192.168.1.5:8000", "192.168.1.5", True),
        ("192.168.1.5:8000", "0.0.0.0", True),
        ("[fe80::1]:8000", "::", True),
        ("evil.example", "0.0.0.0", False),
    ],
)
def test_its_own_names(name: str, host: str, own: bool) -> None:
    assert is_own(name, host) is own


def test_it_listens_on_the_loopback_alone(server: Server) -> None:
    assert server.server_address[0] == "127.0.0.1"


def test_a_page_is_told_of_the_next_build(server: Server, news: News) -> None:
    events = f"http://localhost:{server.server_address[1]}/.reload/events"
    with urllib.request.urlopen(events, timeout=20) as stream:
        assert stream.readline() == b": \n"
        news.finish("", ["a/index.html"])
        lines = [stream.readline() for _ in range(3)]
    told = b'data: {"number": 1, "changed": ["a/index.html"]}\n'
    assert lines == [b"\n", b"event: built\n", told]


def test_fifty_listening_pages_leave_room_for_others(address: str, news: News) -> None:
    streams = [urllib.request.urlopen(f"{address}/.reload/events", timeout=20) for _ in range(50)]
    with urllib.request.urlopen(f"{address}/book.json", timeout=20) as reply:
        assert reply.status == 200
    for stream in streams:
        assert stream.readline() == b"event: built\n"
        stream.close()
    gone = threading.Event()
    for _ in range(3):  # a page that has gone is noticed when it is written to
        news.finish("")
    for _ in range(200):
        if not news.listeners:
            break
        news.finish("")
        gone.wait(0.05)
    assert not news.listeners


def test_a_port_in_use_is_named(tmp_path: Path, news: News) -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(OSError, match=f"port {port} is taken or refused; try .*={port + 1}"):
            start_server(tmp_path, port, news)


def test_a_number_that_is_no_port_is_named(tmp_path: Path, news: News) -> None:
    with pytest.raises(OSError, match="port 99999 is taken or refused; try another: PORT=8000"):
        start_server(tmp_path, 99999, news)


@pytest.mark.parametrize("mistakes", ["", "content/a.md:1: bad"])
def test_before_the_first_good_build_a_page_waits_for_one(
    server: Server, news: News, mistakes: str
) -> None:
    if mistakes:
        news.finish(mistakes)
    with pytest.raises(urllib.error.HTTPError) as raised:
        urllib.request.urlopen(f"http://localhost:{server.server_address[1]}/a.mjs")
    with raised.value as reply:
        assert reply.code == 503
        assert b"/.reload/client.js" in reply.read()


def test_open_pages_hear_of_good_and_of_bad_builds() -> None:
    news = News()
    assert news.event() == ": \n\n"
    news.finish("")
    assert news.event() == 'event: built\ndata: {"number": 1, "changed": []}\n\n'
    news.finish('content/a.md:1: "bad"\nmore')
    assert news.event() == 'event: failed\ndata: "content/a.md:1: \\"bad\\"\\nmore"\n\n'
    news.finish("", ["b"])
    assert news.event() == 'event: built\ndata: {"number": 2, "changed": ["b"]}\n\n'
