"""A reader in front of the book: opens chapters, waits for figures, notes every complaint."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import PurePosixPath
from typing import Any, Protocol

from playwright.sync_api import (
    Browser,
    BrowserContext,
    ConsoleMessage,
    FloatRect,
    Locator,
    Request,
    ViewportSize,
    expect,
)
from support.limits import limit_ms
from support.page_scripts import (
    BRING,
    EVERYTHING,
    FOLLOW,
    LIVE,
    OFFER,
    PUT_BACK,
    SETTLE,
    SHOWN,
    WATCH_SHIFTS,
)

DESK: ViewportSize = {"width": 1280, "height": 900}
PHONE: ViewportSize = {"width": 390, "height": 800}
PULLS = ((41.0, 32.0), (-34.0, 26.0), (40.0, -60.0), (120.0, 0.0))
"""CSS pixels by which a handle is pulled until something moves: it may be at an end, or its next
place far."""

type Place = tuple[float, float]


class Serving(Protocol):
    """A server, by the address of what it serves."""

    url: str


class Reader:
    """One page of one browser profile, at the book's address ``root``."""

    def __init__(self, context: BrowserContext, root: str) -> None:
        self.root = root
        self.complaints: list[str] = []
        self.wants = ""
        self.page = context.new_page()
        self.page.add_init_script(WATCH_SHIFTS)
        self.page.on("console", self._note_console)
        self.page.on("pageerror", lambda error: self.complaints.append(f"uncaught: {error}"))
        context.on("request", self._note_request)

    def _note_console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.complaints.append(f"console: {message.text}")

    def _note_request(self, request: Request) -> None:
        if not request.url.startswith((self.root, "data:", "blob:")):
            self.complaints.append(f"request outside the book: {request.url}")

    def note_requests(self, *endings: str, name: Callable[[str], str] = str) -> list[str]:
        """Requests from now on to addresses that end so, in order."""
        requests: list[str] = []

        def note(request: Request) -> None:
            if request.url.endswith(endings or ""):
                requests.append(name(request.url))

        self.page.on("request", note)
        return requests

    def note_parts(self) -> list[str]:
        """The parts of Python that are requested from now on, in order."""
        return self.note_requests(".zip", name=lambda address: PurePosixPath(address).stem)

    def assert_no_complaints(self) -> None:
        """Nothing was complained of since the last call."""
        complaints = [*self.complaints]
        self.complaints.clear()
        assert not complaints, "\n".join(complaints)

    def forget(self) -> None:
        """Empty the storage of the book, but for what the reader wants from the start."""
        self.page.evaluate(f"localStorage.clear(); sessionStorage.clear(); {self.wants}")

    def keep_no_files(self) -> None:
        """Empty the browser's cache."""
        session = self.page.context.new_cdp_session(self.page)
        session.send("Network.clearBrowserCache")
        session.detach()

    def begin_anew(self, screen: ViewportSize = DESK) -> None:
        """Begin as in a fresh profile: nothing kept, no page but the one loaded next."""
        self.page.set_viewport_size(screen)
        self.page.emulate_media(
            media="null", color_scheme="light", reduced_motion="null", forced_colors="null"
        )
        if self.page.url != "about:blank":
            self.forget()
            self.page.goto("about:blank")

    def open(self, address: str = "", *, live: bool = True) -> None:
        """Open a page of the book, and wait until its figures live if there are any."""
        set_limits(self.page.context)
        self.page.goto(self.root + address)
        if live:
            self.wait_live()

    def leaf_through(self, addresses: Iterable[str]) -> Iterator[str]:
        """Each of these pages in turn, with its fonts: the first is loaded, the others turned to.

        Leaves the figures as they are.
        """
        for number, address in enumerate(addresses):
            if number:
                self.turn_to(address, live=False)
            else:
                self.open(address, live=False)
            self.page.evaluate("document.fonts.ready")
            yield address

    def turn_to(self, address: str, *, live: bool = True) -> None:
        """Follow a link to a page of the book, as a reader does; the interpreter stays alive."""
        if self.page.url == "about:blank":
            self.open(address, live=live)
            return
        set_limits(self.page.context)
        self.page.evaluate(FOLLOW, self.root + address)
        self.page.wait_for_function(
            "url => location.href === url && document.activeElement?.id === 'main'",
            arg=self.root + address,
        )
        if live:
            self.wait_live()

    def turn_to_unlinked(self, address: str) -> None:
        """Turn to an address that another reader sent: no link of this page leads to it."""
        self.page.evaluate(OFFER, self.root + address)
        self.turn_to(address)

    def wait_live(self) -> None:
        self.page.wait_for_function(LIVE)

    def wait_for(self, element: Locator, condition: str, *given: Any) -> None:
        """Wait until a condition, a function of the element and what is given, holds."""
        self.page.wait_for_function(
            f"([element, ...given]) => ({condition})(element, ...given)",
            arg=[element.element_handle(), *given],
        )

    def figure(self, scene: str) -> Locator:
        """The figure of a scene on this page that has no label of its own."""
        return self.page.locator(f"#figure-{scene} simulation-figure")

    def open_figure(self, book: Any, scene: str) -> Locator:
        """Open the first chapter that shows a scene, and bring its figure into view."""
        self.open(chapter_of(book, scene))
        return self._in_view(scene)

    def turn_to_figure(self, book: Any, scene: str) -> Locator:
        """Turn to the first chapter that shows a scene, and bring its figure into view."""
        self.turn_to(chapter_of(book, scene))
        return self._in_view(scene)

    def stay_at_figure(self, book: Any, scene: str) -> Locator:
        """The figure of a scene at rest as its page has put it; the page is turned only where this
        did not lead to it before."""
        chapter = chapter_of(book, scene)
        if self.page.evaluate("document.getElementById('main')?.stays") != chapter:
            self.turn_to(chapter)
            self.page.evaluate("at => { document.getElementById('main').stays = at; }", chapter)
        figure = self._in_view(scene)
        self.put_back(figure)
        return figure

    def _in_view(self, scene: str) -> Locator:
        figure = self.figure(scene)
        self.bring(figure.locator(".control-grid").first)
        return figure

    def bring(self, element: Locator) -> FloatRect:
        """Bring an element to the middle of the window; its place, once it rests there."""
        element.evaluate(BRING)
        place = element.bounding_box()
        assert place, "it is not shown"
        return place

    def middle(self, element: Locator) -> Place:
        """Middle of an element that is shown, in the window."""
        place = element.bounding_box()
        assert place, "it is not shown"
        return place["x"] + place["width"] / 2, place["y"] + place["height"] / 2

    def drag(self, start: Place, end: Place, steps: int = 1) -> None:
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move(*end, steps=steps)
        mouse.up()

    def choose(self, figure: Locator, name: str, option: str) -> None:
        """Choose an option of a menu, and wait for the frame that it makes."""
        self.uncover(figure)
        with self.next_frame(figure):
            figure.locator(f"select[name={name}]").select_option(option)

    def press(self, figure: Locator, key: str) -> None:
        """Press a key on the figure's first slider, and wait for the frame that it makes."""
        with self.next_frame(figure):
            figure.locator("input[type=range]").first.press(key)

    def judged(self, figure: Locator) -> str:
        """The error of what the figure shows, once there is no better estimate to come."""
        self.unfold(figure)
        expect(figure.locator(".accuracy")).to_have_attribute("data-judged", "true")
        return figure.locator(".accuracy-value").inner_text()

    def uncover(self, figure: Locator) -> None:
        """Open the fold of a figure's further controls, where it has one."""
        for fold in figure.locator(".more-controls").all():
            fold.evaluate("fold => { fold.open = true; }")

    def unfold(self, figure: Locator) -> None:
        """Have the figure show how it was computed."""
        figure.locator(".stage-report").evaluate("report => { report.open = true; }")

    def frames(self, figure: Locator) -> int:
        return int(figure.get_attribute("data-frames") or 0)

    def shown(self, figure: Locator) -> Any:
        """What the figure shows: pixels (as a checksum), drawings and readouts."""
        return figure.evaluate(SHOWN)

    def settle(self, figure: Locator) -> None:
        """Wait until the figure has painted nothing new for a while; stop what plays."""
        figure.evaluate(SETTLE)

    def put_back(self, figure: Locator) -> None:
        """Have the figure as the page has put it, at once and at rest."""
        figure.evaluate(PUT_BACK)
        self.settle(figure)

    def wait_frame(self, figure: Locator, after: int) -> None:
        """Wait for a frame later than number ``after``."""
        self.wait_for(figure, "(figure, after) => Number(figure.dataset.frames) > after", after)

    @contextmanager
    def next_frame(self, figure: Locator) -> Iterator[None]:
        """Wait at the end for a frame that was painted since the beginning."""
        frames = self.frames(figure)
        yield
        self.wait_frame(figure, frames)


def set_limits(context: BrowserContext) -> None:
    """Wait no longer in it than is right for this machine, now."""
    context.set_default_timeout(limit_ms())
    expect.set_options(timeout=limit_ms())


@contextmanager
def visit(
    chromium: Browser, server: Serving, script: str = "", *, folded: bool = False, **options: Any
) -> Iterator[Reader]:
    """A reader with a fresh browser profile, in whose pages ``script`` runs first, and who reads
    deeper sections too, unless they stay ``folded``.

    Nothing is kept for reading offline unless ``options`` allow it.
    """
    context = chromium.new_context(**{"viewport": DESK, "service_workers": "block", **options})
    set_limits(context)
    someone = Reader(context, server.url)
    someone.wants = "" if folded else EVERYTHING
    for each in filter(None, (script, someone.wants)):
        someone.page.add_init_script(each)
    try:
        yield someone
    finally:
        context.close()


def chapter_of(book: Any, scene: str) -> str:
    """Address of the first chapter that shows a scene."""
    url: str = next(c["url"] for c in book["chapters"] if scene in c["simulations"])
    return url
