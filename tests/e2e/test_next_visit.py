"""The memory of an interpreter, kept for the next visit: there Python begins where it left off."""

import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect
from support.reader import FRUGAL, START_MS, Reader, visit
from support.static_server import Fault, StaticServer, serving

pytestmark = pytest.mark.browser

MEMORY = Path(__file__).parents[2] / "static" / "js" / "runtime" / "memory.js"
CHAPTER, SCENE = "lens-distortion/", "lens-distortion"
KEEP = """async () => {
  const {assets, runtime, table} = document.body.dataset;
  const script = new URL(assets + 'js/runtime/keeper.js', location.href);
  const keeper = new Worker(script, {type: 'module'});
  const url = new URL(runtime, location.href).href;
  keeper.postMessage({url, known: true, scenes: [], table});
  const {data} = await new Promise((resolve) => { keeper.onmessage = resolve; });
  keeper.terminate();
  return data;
}"""
"""What a page does once it has been at rest for a while and the book is kept on the device."""
HAVE_STARTED = """async () => {
  const {runtime} = document.body.dataset;
  const url = new URL(runtime, location.href).href;
  localStorage.setItem('image-formation:started', JSON.stringify(url));
  await (await fetch(url + 'numpy.linalg._umath_linalg.wasm')).arrayBuffer();
}"""
"""What a browser knows that has started Python before, with its own copy of the machine code."""
KEPT = "caches.keys().then((names) => names.some((name) => name.endsWith('#memory')))"
SPARE = """async () => {
  const name = (await caches.keys()).find((name) => name.endsWith('#memory'));
  const cache = await caches.open(name);
  const [entry] = await cache.keys();
  await (await caches.open('spare')).put(entry, await cache.match(entry));
  return name;
}"""
PUT_BACK = """async (name) => {
  if ((await caches.keys()).includes(name)) return;
  const spare = await caches.open('spare');
  const [entry] = await spare.keys();
  await (await caches.open(name)).put(entry, await spare.match(entry));
}"""
FORGET = "(name) => caches.delete(name)"
READ = """async () => {
  const {recallMemory} = await import(new URL('memory.js', location.href));
  const {runtime} = document.body.dataset;
  const memory = await recallMemory(new URL(runtime, location.href).href);
  const large = {HEAP8: {length: Infinity}, API: {}};
  return memory.goOn(large).then(({scenes}) => `${scenes.length > 0}`, (error) => error.message);
}"""
"""What a start finds of it."""
MAIM = """async (how) => {
  const name = (await caches.keys()).find((name) => name.endsWith('#memory'));
  const cache = await caches.open(name);
  const [entry] = await cache.keys();
  const kept = await cache.match(entry);
  const bytes = new Uint8Array(await kept.arrayBuffer());
  if (how === 'half') bytes.subarray(bytes.length / 2).fill(0);
  if (how === 'one bit') bytes[bytes.length >> 1] ^= 1;
  if (how === 'foreign') bytes[0] ^= 1;
  const about = JSON.parse(kept.headers.get('about'));
  if (how === 'foreign') {
    const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
    about.hash = [...hash].map((byte) => byte.toString(16).padStart(2, '0')).join('');
  }
  const given = how === 'short' ? bytes.subarray(0, 99_999) : bytes;
  await cache.put(entry, new Response(given, {headers: {about: JSON.stringify(about)}}));
}"""


@pytest.fixture(scope="module")
def host(built_site: Path) -> Iterator[StaticServer]:
    with serving(built_site) as server:
        server.uncached = True
        yield server


@pytest.fixture(scope="module")
def returning(brisk_chromium: Browser, host: StaticServer) -> Iterator[tuple[Reader, str]]:
    """A reader whose browser keeps a memory, and the name of its cache."""
    with visit(brisk_chromium, host, FRUGAL) as someone:
        someone.open("licences/", live=False)
        assert someone.page.evaluate(KEEP)
        yield someone, someone.page.evaluate(SPARE)


@pytest.fixture(autouse=True)
def memory(returning: tuple[Reader, str]) -> str:
    """The name of the cache with it, which is as it was kept: who maims it has it forgotten."""
    reader, name = returning
    reader.page.evaluate(PUT_BACK, name)
    return name


@pytest.fixture
def reader(returning: tuple[Reader, str], host: StaticServer) -> Iterator[Reader]:
    yield returning[0]
    host.faults = {}


def moved(reader: Reader, scene: str) -> Any:
    """What a figure shows after a key on its first slider."""
    figure = reader.figure(scene)
    frames = reader.frames(figure)
    figure.locator("input[type=range]").first.press("ArrowRight")
    reader.wait_frame(figure, frames)
    reader.settle(figure)
    return reader.shown(figure)


def test_python_begins_with_the_scenes_imported_before_their_files_have_come(
    reader: Reader, host: StaticServer
) -> None:
    host.faults = {f"/{name}.zip": Fault(late_s=3600) for name in ("core", f"scene-{SCENE}")}
    reader.open(CHAPTER, live=False)
    expect(reader.figure(SCENE)).to_have_attribute("data-state", "live", timeout=START_MS)


@pytest.fixture(scope="module")
def plainly(brisk_chromium: Browser, host: StaticServer) -> Iterator[Reader]:
    """A reader whose browser keeps no memory."""
    with visit(brisk_chromium, host, FRUGAL) as someone:
        yield someone


@pytest.mark.parametrize(
    ("address", "scene"),
    [(CHAPTER, SCENE), ("sampling-and-aliasing/", "aliasing"), ("digital-sensor/", "sensor-noise")],
    ids=["what was imported", "a library without machine code", "a library with machine code"],
)
def test_figures_show_what_they_show_after_a_plain_start(
    reader: Reader, plainly: Reader, address: str, scene: str
) -> None:
    reader.open(address)
    after_memory = moved(reader, scene)
    assert reader.page.evaluate(KEPT), "it was good"
    plainly.turn_to(address)
    assert moved(plainly, scene) == after_memory


def test_a_memory_is_read_whole_or_known_to_be_damaged(reader: Reader, memory: str) -> None:
    # As it is written: in the book the worker's modules are joined.
    reader.page.route("**/memory.js", lambda route: route.fulfill(path=MEMORY))
    assert reader.page.evaluate(READ) == "true"
    for how in ("short", "half", "one bit"):
        reader.page.evaluate(MAIM, how)
        assert reader.page.evaluate(READ) == "the memory is damaged", how
        reader.page.evaluate(FORGET, memory)
        reader.page.evaluate(PUT_BACK, memory)
    reader.page.unroute("**/memory.js")


@pytest.mark.parametrize("how", ["one bit", "foreign"])
def test_a_damaged_memory_is_forgotten_and_python_starts_plainly(reader: Reader, how: str) -> None:
    """Or one that is as it was kept, and none of Python's."""
    reader.page.evaluate(MAIM, how)
    reader.open(CHAPTER)
    moved(reader, SCENE)
    assert not reader.page.evaluate(KEPT)


def test_machine_code_that_has_changed_since_is_replaced_after_the_first_figures(
    brisk_chromium: Browser, server: StaticServer, built_site: Path, tmp_path: Path
) -> None:
    with visit(brisk_chromium, server, FRUGAL) as someone:
        someone.open("licences/", live=False)
        server.root = other_words(built_site, tmp_path / "site")
        someone.page.evaluate(HAVE_STARTED)
        server.root = built_site
        someone.open(CHAPTER)
        (worker,) = someone.page.workers
        figure = someone.figure(SCENE)
        slider = figure.locator("input[type=range]").first
        begun = time.monotonic()
        while someone.page.workers == [worker]:
            assert time.monotonic() - begun < START_MS / 1000
            someone.page.wait_for_timeout(500)  # it is judged some seconds after the start
            frames, setting = someone.frames(figure), slider.input_value()
            slider.press("ArrowRight" if setting == "0" else "ArrowLeft")
            someone.wait_frame(figure, frames, START_MS)
            assert slider.input_value() != setting
        assert figure.get_attribute("data-state") == "live"


def other_words(site: Path, copy: Path) -> Path:
    """The same site, but that some machine code has other words in its texts."""
    shutil.copytree(site, copy, copy_function=os.link)
    (file,) = copy.glob("runtime/*/numpy.linalg._umath_linalg.wasm")
    content = file.read_bytes().replace(b"least squares", b"LEAST SQUARES")
    file.unlink()
    file.write_bytes(content)
    return copy


def test_the_page_has_it_kept_once_the_book_is_kept_and_nothing_goes_on(
    brisk_chromium: Browser, server: StaticServer
) -> None:
    with visit(brisk_chromium, server, service_workers="allow") as someone:
        someone.open(CHAPTER)
        someone.page.wait_for_function(f"() => {KEPT}", timeout=START_MS)
        someone.assert_no_complaints()
