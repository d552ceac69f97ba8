"""A reader of the book in a browser: opens chapters, waits for figures, records every error."""

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
    ADD_LINK,
    CONTENT,
    FOLLOW,
    LIVE,
    RESTORE,
    SCROLL_TO,
    SETTLE,
    UNFOLDED,
    WATCH_SHIFTS,
)

DESK: ViewportSize = {"width": 1280, "height": 900}
PHONE: ViewportSize = {"width": 390, "height": 800}
PULLS = ((41.0, 32.0), (-34.0, 26.0), (40.0, -60.0), (120.0, 0.0))
"""CSS pixels by which a handle is dragged until something moves: it may be at the end of its range,
or its next position may be far."""

type Place = tuple[float, float]


class Serving(Protocol):
    """A server, known by its address."""

    url: str


class Reader:
    """One page of one browser profile, with the book at the address ``root``."""

    def __init__(self, context: BrowserContext, root: str) -> None:
        self.root = root
        self.errors: list[str] = []
        self.preferences = ""
        self.page = context.new_page()
        self.page.add_init_script(WATCH_SHIFTS)
        self.page.on("console", self._note_console)
        self.page.on("pageerror", lambda error: self.errors.append(f"uncaught: {error}"))
        context.on("request", self._note_request)

    def _note_console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.errors.append(f"console: {message.text}")

    def _note_request(self, request: Request) -> None:
        if not request.url.startswith((self.root, "data:", "blob:")):
            self.errors.append(f"request outside the book: {request.url}")

    def record_requests(self, *endings: str, name: Callable[[str], str] = str) -> list[str]:
        """Requests made from now on to addresses with one of these endings, in order."""
        requests: list[str] = []

        def note(request: Request) -> None:
            if request.url.endswith(endings or ""):
                requests.append(name(request.url))

        self.page.on("request", note)
        return requests

    def record_parts(self) -> list[str]:
        """The parts of Python that are requested from now on, in order."""
        return self.record_requests(".zip", name=lambda address: PurePosixPath(address).stem)

    def assert_no_errors(self) -> None:
        """Assert that the browser reported no error since the last call."""
        errors = [*self.errors]
        self.errors.clear()
        assert not errors, "\n".join(errors)

    def clear_storage(self) -> None:
        """Empty the book's storage, except for the preferences of this reader."""
        self.page.evaluate(f"localStorage.clear(); sessionStorage.clear(); {self.preferences}")

    def clear_cache(self) -> None:
        """Empty the browser's cache."""
        session = self.page.context.new_cdp_session(self.page)
        session.send("Network.clearBrowserCache")
        session.detach()

    def reset(self, screen: ViewportSize = DESK) -> None:
        """Restore a fresh profile: default media, empty storage and a blank page."""
        self.page.set_viewport_size(screen)
        self.page.emulate_media(
            media="null", color_scheme="light", reduced_motion="null", forced_colors="null"
        )
        if self.page.url != "about:blank":
            self.clear_storage()
            self.page.goto("about:blank")

    def open(self, address: str = "", *, live: bool = True) -> None:
        """Open a page of the book, and wait until all its figures are live."""
        set_limits(self.page.context)
        self.page.goto(self.root + address)
        if live:
            self.wait_live()

    def open_each(self, addresses: Iterable[str]) -> Iterator[str]:
        """Open each of these pages with its fonts: load the first, then turn to the others.

        It does not wait for the figures.
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
        """Turn to an address that no link of this page leads to, such as one in a message."""
        self.page.evaluate(ADD_LINK, self.root + address)
        self.turn_to(address)

    def wait_live(self) -> None:
        self.page.wait_for_function(LIVE)

    def wait_for(self, element: Locator, condition: str, *given: Any) -> None:
        """Wait until a condition holds; it is a function of the element and the arguments."""
        self.page.wait_for_function(
            f"([element, ...given]) => ({condition})(element, ...given)",
            arg=[element.element_handle(), *given],
        )

    def figure(self, scene: str) -> Locator:
        """The figure of a scene on this page, where the author gave it no label."""
        return self.page.locator(f"#figure-{scene} simulation-figure")

    def open_figure(self, book: Any, scene: str) -> Locator:
        """Open the first chapter that shows a scene, and bring its figure into view."""
        self.open(chapter_of(book, scene))
        return self._in_view(scene)

    def turn_to_figure(self, book: Any, scene: str) -> Locator:
        """Turn to the first chapter that shows a scene, and bring its figure into view."""
        self.turn_to(chapter_of(book, scene))
        return self._in_view(scene)

    def figure_at_rest(self, book: Any, scene: str) -> Locator:
        """The figure of a scene, at rest at its page's settings; turns to its page only if the last
        call was for another page."""
        chapter = chapter_of(book, scene)
        if self.page.evaluate("document.getElementById('main')?.stays") != chapter:
            self.turn_to(chapter)
            self.page.evaluate("at => { document.getElementById('main').stays = at; }", chapter)
        figure = self._in_view(scene)
        self.restore(figure)
        return figure

    def _in_view(self, scene: str) -> Locator:
        figure = self.figure(scene)
        self.scroll_to(figure.locator(".control-grid").first)
        return figure

    def scroll_to(self, element: Locator) -> FloatRect:
        """Scroll an element to the middle of the window, and return its box once it is at rest."""
        element.evaluate(SCROLL_TO)
        place = element.bounding_box()
        assert place, "it is not shown"
        return place

    def middle(self, element: Locator) -> Place:
        """The middle of a visible element, in coordinates of the window."""
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
        self.open_controls(figure)
        with self.next_frame(figure):
            figure.locator(f"select[name={name}]").select_option(option)

    def press(self, figure: Locator, key: str) -> None:
        """Press a key on the figure's first slider, and wait for the frame that it makes."""
        with self.next_frame(figure):
            figure.locator("input[type=range]").first.press(key)

    def final_error(self, figure: Locator) -> str:
        """The figure's estimate of its error, once it is final."""
        self.open_stage_report(figure)
        expect(figure.locator(".accuracy")).to_have_attribute("data-judged", "true")
        return figure.locator(".accuracy-value").inner_text()

    def open_controls(self, figure: Locator) -> None:
        """Open the figure's further controls, if it has any."""
        for fold in figure.locator(".more-controls").all():
            fold.evaluate("fold => { fold.open = true; }")

    def open_stage_report(self, figure: Locator) -> None:
        """Open the figure's report on how it was computed."""
        figure.locator(".stage-report").evaluate("report => { report.open = true; }")

    def frames(self, figure: Locator) -> int:
        return int(figure.get_attribute("data-frames") or 0)

    def content(self, figure: Locator) -> Any:
        """The figure's pixels (as a checksum), drawings and readouts."""
        return figure.evaluate(CONTENT)

    def settle(self, figure: Locator) -> None:
        """Stop animations, and wait until the figure paints no new frame."""
        figure.evaluate(SETTLE)

    def restore(self, figure: Locator) -> None:
        """Return the figure to its page's settings at once, and wait until it is at rest."""
        figure.evaluate(RESTORE)
        self.settle(figure)

    def wait_frame(self, figure: Locator, after: int) -> None:
        """Wait for a frame later than number ``after``."""
        self.wait_for(figure, "(figure, after) => Number(figure.dataset.frames) > after", after)

    @contextmanager
    def next_frame(self, figure: Locator) -> Iterator[None]:
        """Wait on exit for a frame painted since entry."""
        frames = self.frames(figure)
        yield
        self.wait_frame(figure, frames)


def set_limits(context: BrowserContext) -> None:
    """Set the time limits of all waits by the present speed of this machine."""
    context.set_default_timeout(limit_ms())
    expect.set_options(timeout=limit_ms())


@contextmanager
def visit(
    chromium: Browser, server: Serving, script: str = "", *, folded: bool = False, **options: Any
) -> Iterator[Reader]:
    """A reader with a fresh browser profile; ``script`` runs first in each page, and deeper
    sections are open unless ``folded``.

    Nothing is stored for reading offline unless ``options`` allow it.
    """
    context = chromium.new_context(**{"viewport": DESK, "service_workers": "block", **options})
    set_limits(context)
    reader = Reader(context, server.url)
    reader.preferences = "" if folded else UNFOLDED
    for each in filter(None, (script, reader.preferences)):
        reader.page.add_init_script(each)
    try:
        yield reader
    finally:
        context.close()


def chapter_of(book: Any, scene: str) -> str:
    """Address of the first chapter that shows a scene."""
    url: str = next(c["url"] for c in book["chapters"] if scene in c["simulations"])
    return url


@contextmanager
def step(name: str) -> Iterator[None]:
    """A named part of a long test; a failure has a note with the name."""
    try:
        yield
    except BaseException as failure:  # `pytest.fail` raises no Exception
        failure.add_note(f"in the step: {name}")
        raise
