"""Links that lead out of the book, followed: only where an author asks, for it needs a network.

Hosts are asked side by side, and each one link at a time with a pause between them. A host is
asked for the head of a page alone; where it does not tell, for the page. No host is waited for
longer than `Patience` allows, also one that answers a letter at a time or leads on for ever.
"""

import ssl
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from email.message import Message
from functools import cache
from http.client import HTTPException
from queue import Empty, SimpleQueue
from typing import IO
from urllib.parse import quote, urldefrag, urlsplit

from site_builder.book import Book
from site_builder.diagnostics import Diagnostic
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY

GONE = (404, 410)
MOVED = (301, 308)
AT_ONCE = 8
"""Hosts that are asked side by side."""
WHO = {"User-Agent": "Mozilla/5.0 (compatible; a book's check of its links)", "Accept": "*/*"}

type Place = tuple[str, int]
"""File and line."""


@dataclass(frozen=True, slots=True)
class Patience:
    """How long a host is waited for, and left alone between two links, in seconds."""

    timeout: float = 10.0
    """For a link, with all redirections and tries."""
    pause: float = 0.5
    tries: int = 2
    """Links that a host may leave unanswered; those after them are not asked for."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What came of a link."""

    status: int = 0
    """Of HTTP; 0 where nobody answered."""
    reason: str = ""
    moved_to: str = ""
    """Where the page is for good, if not where the link says."""


def outside_links(book: Book) -> dict[str, tuple[Place, ...]]:
    """Every address that the book leads to, with the places that do."""
    found: dict[str, list[Place]] = {}
    for chapter in book.chapters:
        for link in chapter.outside:
            found.setdefault(link.target, []).append((chapter.path, link.line))
    for work in book.bibliography.works.values():
        if work.address:
            found.setdefault(work.address, []).append((BIBLIOGRAPHY, work.line))
    return {address: tuple(places) for address, places in found.items()}


def check_outside_links(
    links: Mapping[str, Sequence[Place]], patience: Patience | None = None
) -> list[Diagnostic]:
    """A mistake for each place that leads to nothing; a warning for one that leads elsewhere, or
    whose host does not tell. One warning in all where no host can be reached."""
    answers = _ask_all(list(links), patience or Patience())
    if answers and not any(answer.status for answer in answers.values()):
        reason = next(iter(answers.values())).reason
        path, line = next(iter(links.values()))[0]
        message = f"none of {len(answers)} outside links can be reached ({reason}); "
        return [Diagnostic(path, line, message + "better: with a network", fails=False)]
    return sorted(
        found
        for address, places in links.items()
        for place in places
        for found in _told(address, answers[address], place)
    )


def _told(address: str, answer: Answer, place: Place) -> Iterator[Diagnostic]:
    ok = 200 <= answer.status < 300
    if answer.status in GONE or not answer.status:
        expected = "an address that answers"
        yield Diagnostic(*place, f"link {address!r}: {answer.reason}; legal: {expected}")
    elif not ok:
        message = f"link {address!r} cannot be judged: {answer.reason}"
        yield Diagnostic(*place, message, fails=False)
    elif answer.moved_to:
        message = f"link {address!r} has moved; better: {answer.moved_to!r}"
        yield Diagnostic(*place, message, fails=False)


def _ask_all(addresses: Sequence[str], patience: Patience) -> dict[str, Answer]:
    hosts: dict[str, list[str]] = {}
    for address in addresses:
        hosts.setdefault(urlsplit(address).netloc.lower(), []).append(address)
    answers: dict[str, Answer] = {}
    lock = threading.Lock()

    def ask_host(own: Sequence[str]) -> None:
        unanswered = 0
        for index, address in enumerate(own):
            if unanswered < patience.tries:
                if index:
                    time.sleep(patience.pause)
                answer = ask(address, patience.timeout)
                unanswered += not answer.status
            else:
                answer = Answer(reason=f"its host did not answer {unanswered} other links")
            with lock:
                answers[address] = answer

    with ThreadPoolExecutor(AT_ONCE) as pool:
        list(pool.map(ask_host, hosts.values()))
    return answers


def ask(address: str, timeout: float) -> Answer:
    """What the host says of a link within ``timeout`` seconds, followed wherever it leads.

    A timeout of the socket's begins again with each letter that comes, and a name is looked up
    without one: so a thread asks, which is left to itself when the time is over.
    """
    answers: SimpleQueue[Answer] = SimpleQueue()
    asks = threading.Thread(target=lambda: answers.put(_follow(address, timeout)), daemon=True)
    asks.start()
    try:
        return answers.get(timeout=timeout)
    except Empty:
        return Answer(reason=f"no answer within {timeout:g} s")


def _follow(address: str, timeout: float) -> Answer:
    answer = _request(address, "HEAD", timeout)
    if 200 <= answer.status < 300 or not answer.status:
        return answer
    return _request(address, "GET", timeout)  # many a host knows nothing else


def _request(address: str, method: str, timeout: float) -> Answer:
    redirects = _Redirects()
    secured = urllib.request.HTTPSHandler(context=_trusted())
    opener = urllib.request.build_opener(redirects, secured)
    try:
        url = quote(urldefrag(address).url, safe="/:?#[]@!$&'()*+,;=%~-._")
        request = urllib.request.Request(url, method=method, headers=WHO)
        with opener.open(request, timeout=timeout) as response:
            moved = response.geturl() if redirects.for_good else ""
            return Answer(response.status, moved_to=moved)
    except urllib.error.HTTPError as error:
        with error:
            return Answer(error.code, f"{error.code} {error.reason}")
    except urllib.error.URLError as error:
        return Answer(reason=str(error.reason))
    except TimeoutError:
        return Answer(reason=f"no answer within {timeout:g} s")
    except (OSError, HTTPException, ValueError) as error:
        return Answer(reason=f"{type(error).__name__}: {error}")


@cache
def _trusted() -> ssl.SSLContext:
    """Whose certificates count. To read them takes longer than to ask."""
    context = ssl.create_default_context()
    context.set_alpn_protocols(["http/1.1"])
    return context


class _Redirects(urllib.request.HTTPRedirectHandler):
    """Follows them, and remembers whether all were for good."""

    def __init__(self) -> None:
        self.codes: list[int] = []

    @property
    def for_good(self) -> bool:
        return bool(self.codes) and all(code in MOVED for code in self.codes)

    def redirect_request(
        self,
        req: urllib.request.Request,
        fp: IO[bytes],
        code: int,
        msg: str,
        headers: Message,
        newurl: str,
    ) -> urllib.request.Request | None:
        self.codes.append(code)
        request = super().redirect_request(req, fp, code, msg, headers, newurl)  # type: ignore[arg-type]
        if request is not None:
            request.method = req.get_method()
        return request
