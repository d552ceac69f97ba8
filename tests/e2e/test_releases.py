"""A page that stays open while its host takes up another release: the files of its own are gone."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from support.page_scripts import FRUGAL
from support.reader import Reader, visit
from support.static_server import StaticServer, serving

pytestmark = pytest.mark.browser

CHAPTER, SCENE, NEXT = "why-image-formation/", "formation-pipeline", "connections/"
ASK = """async (part) => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const runtime = inside.sharedRuntime();
  const asked = {ladder: 'shading', tier: 'any', budget: 0.001};
  return runtime.call('measure', asked).then(() => '', (error) => error.message);
}"""
"""What is said where a part is asked for late."""
ADDRESSES = """() => performance.getEntriesByType('resource').map(({name}) => name)"""


@pytest.fixture
def next_release(built_site: Path, tmp_path: Path) -> Path:
    """The book as it is, with its assets and its Python in folders of other names."""
    folders = [next((built_site / kind).iterdir()) for kind in ("assets", "runtime")]
    for page in built_site.rglob("*.html"):
        if any(page.is_relative_to(folder) for folder in folders):
            continue
        text = page.read_text(encoding="utf-8")
        for folder in folders:
            text = text.replace(folder.name, folder.name[::-1])
        new = tmp_path / page.relative_to(built_site)
        new.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(text, encoding="utf-8")
    for folder in folders:
        (tmp_path / folder.parent.name).mkdir()
        (tmp_path / folder.parent.name / folder.name[::-1]).symlink_to(folder)
    return tmp_path


@pytest.fixture
def host(built_site: Path) -> Iterator[StaticServer]:
    with serving(built_site) as server:
        yield server


@pytest.fixture
def reader(brisk_chromium: Browser, host: StaticServer) -> Iterator[Reader]:
    with visit(brisk_chromium, host, FRUGAL) as someone:
        yield someone


def test_a_page_of_an_earlier_release_runs_on_says_so_and_leads_to_a_whole_page_of_the_next(
    reader: Reader, host: StaticServer, next_release: Path
) -> None:
    reader.open(CHAPTER)
    page, notice = reader.page, reader.page.locator(".notice")
    own = page.evaluate("document.body.dataset.runtime")
    figure = reader.figure(SCENE)
    reader.press(figure, "PageUp")
    host.root = next_release

    page.locator("[data-reveal]:visible").first.click()
    page.locator("a.set:visible").first.click()
    assert "has been updated" in notice.inner_text(), "the script that moves figures is gone"
    notice.get_by_role("button", name="Close").click()
    assert "ladder-shading.zip could not be loaded: the server answered 404" in page.evaluate(ASK)

    reader.press(figure, "PageUp")

    page.locator(f"a[href='../{NEXT}']").last.click()
    page.wait_for_url(f"**/{NEXT}")
    reader.wait_live()
    assert page.evaluate("document.body.dataset.runtime") != own
    old = own.strip("./").split("/")[-1]
    loaded = page.evaluate(ADDRESSES)
    assert any("/runtime/" in address for address in loaded)
    assert not [address for address in loaded if old in address], "nothing of both"
