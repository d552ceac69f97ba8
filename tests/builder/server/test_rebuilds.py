"""Builds in processes of their own, and what open pages learn of them."""

import asyncio
from collections.abc import Coroutine
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from site_builder.server.builds import Builds
from site_builder.server.news import News, State

SCRIPT = """\
import pathlib, sys, time
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
(out.parent / "started").open("a").write("x")
sys.stdin.readline() or sys.exit()
(out / "a.html").write_text("new")
{then}
"""
SHEET = "assets/now/css/book.css"


def run[T](task: Coroutine[object, object, T]) -> T:
    """In a thread of its own: the tests' browser has an event loop in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, task).result()


def build(builds: Builds) -> None:
    async def once() -> None:
        await builds.build()
        await builds.end_waiting()

    run(once())


@pytest.fixture
def builds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Builds:
    """Of a book whose builder is a script of the test's."""
    (tmp_path / "site_builder").mkdir()
    (tmp_path / "site/assets/now/css").mkdir(parents=True)
    (tmp_path / "static/css").mkdir(parents=True)
    monkeypatch.setattr("site_builder.server.builds.ENGINE", tmp_path)
    return Builds(tmp_path, tmp_path / "site", True, News(), "http://localhost:8000/")


def write_builder(builds: Builds, then: str = "") -> None:
    script = builds.root / "site_builder" / "__main__.py"
    script.write_text(SCRIPT.format(then=then))


def test_a_good_build_names_what_it_changed(
    builds: Builds, capsys: pytest.CaptureFixture[str]
) -> None:
    write_builder(builds, "print('1 file')")
    build(builds)
    assert builds.news.state == State(1, ("a.html",))
    assert capsys.readouterr().out == "1 file\nhttp://localhost:8000/\n"
    build(builds)
    assert capsys.readouterr().out == "1 file\n"


def test_a_bad_build_says_what_is_wrong_until_the_next_good_one(builds: Builds) -> None:
    write_builder(builds, "sys.exit('content/a.md:1: bad')")
    build(builds)
    assert builds.news.state.mistakes == "content/a.md:1: bad\n"
    write_builder(builds)
    build(builds)
    assert builds.news.state.mistakes == ""


def test_a_build_that_is_killed_is_told_by_its_exit_code(builds: Builds) -> None:
    write_builder(builds, "import os; os.kill(os.getpid(), 9)")
    build(builds)
    assert builds.news.state.mistakes == "the build ended with exit code -9"


def test_a_cancelled_build_ends_its_process(builds: Builds) -> None:
    write_builder(builds, "time.sleep(1); (out / 'late.html').write_text('')")

    async def overtaken() -> None:
        build = asyncio.create_task(builds.build())
        while not (builds.out / "a.html").exists():
            await asyncio.sleep(0.01)
        build.cancel()
        await asyncio.wait([build])
        await asyncio.sleep(1.2)

    run(overtaken())
    assert not (builds.out / "late.html").exists()
    assert builds.news.state == State()


@pytest.mark.parametrize(("renewed", "text"), [(True, "newer"), (False, "old")])
def test_the_next_build_has_its_code_already_unless_that_has_changed(
    builds: Builds, renewed: bool, text: str
) -> None:
    def writing(word: str) -> str:
        return f"import pathlib; pathlib.Path('{builds.out}/b.html').write_text('{word}')"

    async def two_builds() -> None:
        write_builder(builds, writing("old"))
        await builds.build()
        while (builds.root / "started").read_text() != "xx":
            await asyncio.sleep(0.01)
        write_builder(builds, writing("newer"))  # of another length: compiled code goes by it
        if renewed:
            await builds.end_waiting()
        await builds.build()
        await builds.end_waiting()

    run(two_builds())
    assert (builds.out / "b.html").read_text() == text


def build_with_styles(builds: Builds) -> None:
    """Of two sheets, the first is in the joined one."""
    write_builder(builds)
    (builds.root / "static/css/a.css").write_text("a { top: 1px }")
    (builds.root / "static/css/unused.css").write_text("b { top: 2px }")
    (builds.out / SHEET).write_text("x {} a { top: 1px } y {}")
    build(builds)


def test_a_changed_style_sheet_is_replaced_without_a_build(builds: Builds) -> None:
    build_with_styles(builds)
    sheet = builds.root / "static/css/a.css"
    for edited in ("a { top: 9px }", "a { top: 8px }"):
        sheet.write_text(edited)
        assert builds.replace_styles([sheet])
        assert (builds.out / SHEET).read_text() == f"x {{}} {edited} y {{}}"
    assert builds.news.state == State(3, (SHEET,))


@pytest.mark.parametrize("other", ["static/css/unused.css", "content/a.md", "static/css/new.css"])
def test_what_a_joined_sheet_does_not_hold_needs_a_build(builds: Builds, other: str) -> None:
    build_with_styles(builds)
    changed = [builds.root / name for name in ("static/css/a.css", other)]
    for path in changed:
        path.parent.mkdir(exist_ok=True)
        path.write_text("c { top: 3px }")
    assert not builds.replace_styles(changed)


def test_after_a_bad_build_a_style_sheet_needs_a_build(builds: Builds) -> None:
    build_with_styles(builds)
    builds.news.fail("bad")
    assert not builds.replace_styles([builds.root / "static/css/a.css"])


def test_a_page_that_listens_gets_the_present_state_and_then_the_newest() -> None:
    async def listen() -> list[str]:
        news = News()
        events = aiter(news.events())
        heard = [await anext(events)]
        news.succeed(["a"])
        news.fail('a.md:1: "bad"\nmore')
        heard.append(await anext(events))
        news.succeed(["b"])
        heard.append(await anext(events))
        return heard

    assert run(listen()) == [
        ": \n\n",
        'event: failed\ndata: "a.md:1: \\"bad\\"\\nmore"\n\n',
        'event: built\ndata: {"number": 2, "changed": ["b"]}\n\n',
    ]
