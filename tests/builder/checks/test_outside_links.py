"""Links out of the book, followed to a server of our own that answers as servers do."""

import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler

import pytest
from support.static_server import QuietServer, running

from site_builder.build import Options, check_site
from site_builder.checks.outside_links import Patience, check_outside_links, outside_links

PATIENT = Patience(timeout=20.0, pause=0.0)
BRIEF = Patience(timeout=0.2, pause=0.0)


class Host(BaseHTTPRequestHandler):
    """Its pages are named for what they do."""

    asked: list[tuple[str, str]]
    release: threading.Event

    def do_HEAD(self) -> None:
        self.asked.append((self.command, self.path))
        match self.path.partition("?")[0].strip("/").split("/"):
            case ["moved" | "moved-on" as kind, *rest]:
                self.answer(301 if kind == "moved" else 302, "/" + "/".join(rest))
            case ["round"]:
                self.answer(301, "/round")
            case ["no-head"] if self.command == "HEAD":
                self.answer(405)
            case ["hangs"]:
                self.release.wait()
            case ["letters"]:  # of a head that never ends
                self.wfile.write(b"HTTP/1.1 200 OK\r\nX-")
                while not self.release.wait(0.02):
                    self.wfile.write(b"x")
            case ["silent"]:
                self.close_connection = True
            case [status] if status.isdigit():
                self.answer(int(status))
            case _:
                self.answer(200)

    def do_GET(self) -> None:
        self.do_HEAD()

    def answer(self, status: int, location: str = "") -> None:
        self.send_response(status)
        if location:
            self.send_header("Location", location)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, *_: object) -> None:
        """Tests have their own words."""


@pytest.fixture
def host(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    monkeypatch.setenv("no_proxy", "*")
    Host.asked, Host.release = [], threading.Event()
    server = QuietServer(("127.0.0.1", 0), Host)
    with running(server):
        yield f"http://127.0.0.1:{server.server_address[1]}"
        Host.release.set()


def told(host: str, *paths: str, patience: Patience = PATIENT) -> list[str]:
    """What is said of links to these pages, one a line; beside one that is in order, since where
    none answers there may be no network."""
    links = {f"{host}{path}": [("a.md", line)] for line, path in enumerate(("/", *paths))}
    return [str(found).replace(host, "") for found in check_outside_links(links, patience)]


@pytest.mark.parametrize("path", ["/200", "/204", "/a#section", "/no-head", "/moved-on/a", "/ä b"])
def test_a_link_that_leads_somewhere_is_in_order(host: str, path: str) -> None:
    assert told(host, path) == []


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("/404", "a.md:1: link '/404': 404 Not Found; legal: an address that answers"),
        ("/410", "a.md:1: link '/410': 410 Gone; legal: an address that answers"),
        ("/silent", "a.md:1: link '/silent': "),
        ("/moved/404", "a.md:1: link '/moved/404': 404 Not Found; legal: "),
        ("/moved/a", "a.md:1: warning: link '/moved/a' has moved; better: '/a'"),
        ("/moved/moved/a", "a.md:1: warning: link '/moved/moved/a' has moved; better: '/a'"),
        ("/403", "a.md:1: warning: link '/403' cannot be judged: 403 Forbidden"),
        ("/500", "a.md:1: warning: link '/500' cannot be judged: 500 "),
        ("/round", "a.md:1: warning: link '/round' cannot be judged: 301 "),
    ],
)
def test_a_link_that_leads_nowhere_or_elsewhere_is_told(host: str, path: str, says: str) -> None:
    (found,) = told(host, path)
    assert found.startswith(says)


@pytest.mark.parametrize("path", ["/hangs", "/letters"])
def test_a_host_that_does_not_end_is_not_waited_for_for_ever(host: str, path: str) -> None:
    links = {f"{host}{path}": [("a.md", 1)]}
    (found,) = check_outside_links(links, BRIEF)
    assert "timed out" in found.message or "no answer" in found.message
    assert not Host.release.is_set()


def test_a_host_that_leaves_links_unanswered_is_not_asked_on(host: str) -> None:
    paths = [f"/silent?{number}" for number in range(4)]
    found = told(host, *paths)
    assert [path for _, path in Host.asked] == ["/", *paths[:2]]
    assert "its host did not answer 2 other links" in found[-1]


def test_a_page_is_asked_for_only_where_its_head_is_not_told(host: str) -> None:
    told(host, "/a", "/no-head")
    assert sorted(Host.asked) == [
        ("GET", "/no-head"), ("HEAD", "/"), ("HEAD", "/a"), ("HEAD", "/no-head"),
    ]  # fmt: skip


def test_an_address_is_asked_once_however_often_it_is_linked(host: str) -> None:
    places = [("a.md", 3), ("b.md", 4)]
    found = check_outside_links({f"{host}/404": places, f"{host}/": [("c.md", 1)]}, PATIENT)
    assert [(one.path, one.line) for one in found] == places
    assert Host.asked.count(("HEAD", "/404")) == 1


def test_without_a_network_one_warning_says_so(host: str) -> None:
    links = {f"{host}/silent": [("a.md", 3)], "http://127.0.0.1:1/": [("b.md", 1)]}
    (found,) = check_outside_links(links, PATIENT)
    assert not found.fails
    assert found.message.startswith("none of 2 outside links can be reached")


def test_the_links_of_a_book_are_those_of_its_text_and_of_its_works(
    make_book: Callable[..., Options],
) -> None:
    work = (
        "@book{a, author = {A. B.}, title = {T}, year = {2000},\n"
        "  publisher = {P}, url = {https://a.example/x}}\n"
    )
    body = "See [this](https://b.example/).\n\n{cite}`a`\n\n:::{note} [That](https://c.example/)\nText.\n:::\n"
    book, *_ = check_site(make_book(body, {"content/references.bib": work}))
    assert outside_links(book) == {
        "https://b.example/": (("content/00-first.md", 5),),
        "https://c.example/": (("content/00-first.md", 9),),
        "https://a.example/x": (("content/references.bib", 1),),
    }
