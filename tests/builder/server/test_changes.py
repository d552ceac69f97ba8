"""What a server learns of changes, wherever the book lies and whatever is done to its folders."""

import asyncio
import shutil
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from site_builder.server import changes as module
from site_builder.server.changes import changes


def test_changes_are_reported_in_hidden_places_behind_links_and_after_a_folder_was_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "LOOK_MS", 60)
    root = tmp_path / ".venv" / "node_modules" / "book"
    content, site, elsewhere = root / "content", root / "build", tmp_path / "elsewhere.md"
    elsewhere.write_text("one")
    for folder in (content, site):
        folder.mkdir(parents=True)
    (content / "linked.md").symlink_to(elsewhere)

    def replace_content() -> None:
        shutil.copytree(content, root / "new", symlinks=True)
        shutil.rmtree(content)
        (root / "new").rename(content)

    def write_beside() -> None:
        for name in (".a.md.swp", "a.md~", "__pycache__", ".git/x"):
            (content / name).parent.mkdir(exist_ok=True)
            (content / name).write_text("")
        (content / "b.md").write_text("")

    steps: list[tuple[Callable[[], object], Path]] = [
        (lambda: (content / "a.md").write_text("text"), content / "a.md"),
        (lambda: elsewhere.write_text("another"), content / "linked.md"),
        (replace_content, content),
        (lambda: (content / "a.md").write_text("new"), content / "a.md"),
        (lambda: shutil.rmtree(site), site),
        (write_beside, content / "b.md"),
    ]

    async def watch() -> list[set[Path]]:
        found, reports = [], aiter(changes([content], site))
        waiting = asyncio.ensure_future(anext(reports))
        for step, path in steps:
            await asyncio.sleep(0.3)
            step()
            seen: set[Path] = set()
            while path not in seen:
                seen |= await asyncio.wait_for(waiting, 10)
                waiting = asyncio.ensure_future(anext(reports))
            found.append(seen)
        waiting.cancel()
        return found

    with ThreadPoolExecutor(1) as pool:  # the tests' browser has an event loop in this thread
        found = pool.submit(asyncio.run, watch()).result()
    assert found[0] == {content / "a.md"}
    assert found[-1] == {content / "b.md"}
