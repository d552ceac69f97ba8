"""What the development server sends: right types, parts, nothing outside the site."""

import shutil
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from site_builder.server.app import make_app
from site_builder.server.command import listen
from site_builder.server.news import News

FILES = ("a.mjs", "a.wasm", "404.html", "book.json", "a.woff2", "folder/a.css", "b/index.html")


@pytest.fixture
def news() -> News:
    return News()


@pytest.fixture
def site(tmp_path: Path) -> Path:
    (tmp_path / "outside.txt").write_text("secret")
    site = tmp_path / "site"
    for name in FILES:
        (site / name).parent.mkdir(parents=True, exist_ok=True)
        (site / name).write_text(name)
    (site / "link.txt").symlink_to(tmp_path / "outside.txt")
    return site


@pytest.fixture
def client(site: Path, news: News) -> TestClient:
    news.succeed([])
    return TestClient(make_app(site, news, "127.0.0.1"), "http://localhost:8000")


@pytest.mark.parametrize(
    ("name", "media_type"),
    [
        ("a.mjs", "text/javascript; charset=utf-8"),
        ("a.wasm", "application/wasm"),
        ("a.woff2", "font/woff2"),
        ("book.json", "application/json"),
    ],
)
def test_a_file_has_the_type_that_browsers_insist_on(
    client: TestClient, name: str, media_type: str
) -> None:
    assert client.get(f"/{name}").headers["Content-Type"] == media_type


@pytest.mark.parametrize("path", ["/nothing/here", "/%2e%2e/outside.txt", "/link.txt", "/folder/"])
def test_what_is_no_file_of_the_site_gets_the_book_s_own_page(
    client: TestClient, path: str
) -> None:
    reply = client.get(path)
    assert (reply.status_code, reply.text) == (404, "404.html")


@pytest.mark.parametrize(
    ("host", "name", "status"),
    [
        ("127.0.0.1", "localhost:8000", 200),
        ("127.0.0.1", "[::1]:8000", 200),
        ("127.0.0.1", "evil.example", 400),
        ("127.0.0.1", "localhost.evil.example", 400),
        ("127.0.0.1", "192.168.1.5:8000", 400),
        ("192.168.1.5", "192.168.1.5:8000", 200),
        ("0.0.0.0", "192.168.1.5:8000", 200),
    ],
)
def test_a_request_by_another_name_is_refused(
    site: Path, news: News, host: str, name: str, status: int
) -> None:
    news.succeed([])
    client = TestClient(make_app(site, news, host))
    for path in ("/b/", "/.reload/client.js"):
        assert client.get(path, headers={"Host": name}).status_code == status


@pytest.mark.parametrize("mistakes", ["", "content/a.md:1: bad"])
def test_before_the_first_good_build_a_page_waits_for_one(
    site: Path, news: News, mistakes: str
) -> None:
    if mistakes:
        news.fail(mistakes)
    reply = TestClient(make_app(site, news, "127.0.0.1"), "http://localhost").get("/b/")
    assert reply.status_code == 503
    assert "/.reload/client.js" in reply.text


def test_a_port_that_cannot_be_used_is_named() -> None:
    with listen("127.0.0.1", 0) as other:
        port = other.getsockname()[1]
        for number, better in ((port, port + 1), (99999, 8000)):
            with pytest.raises(OSError, match=f"port {number} is taken .*={better}"):
                listen("127.0.0.1", number)


def test_a_site_that_was_deleted_is_being_built(client: TestClient, site: Path, news: News) -> None:
    shutil.rmtree(site)
    reply = client.get("/b/")
    assert reply.status_code == 503
    assert "Being built" in reply.text
    assert news.state.event() == ": \n\n"  # or the page would reload itself at once
