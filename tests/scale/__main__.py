"""``python -m scale --tools BIN [--chapters 10 100 1000]``: builders compared, on one text.

Each builds the same books in the same run, one of every kind of thing and one of prose: cold, and
again after one edited line. What this
builder keeps between builds is filled by a book of one chapter first, which fetches and cuts what
any book needs, and put back so before every cold build.
"""

import argparse
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from scale.cost import Cost, cost_of
from scale.report import Run, report
from scale.text import BOOKS
from scale.trees import BUILDERS, Builder, edit_line, write_book

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    parser = argparse.ArgumentParser(prog="scale", description=__doc__)
    parser.add_argument("--tools", type=Path, required=True, help="where mkdocs and Sphinx are")
    parser.add_argument("--chapters", type=int, nargs="+", default=[10, 100, 1000])
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "scale.md")
    parser.add_argument("--books", nargs="+", default=[*BOOKS], choices=BOOKS)
    given = parser.parse_args()
    tools = given.tools.resolve()
    text = "\n".join(
        f"## A book of {kind}\n\n{report([*_runs(kind, given.chapters, tools)])}"
        for kind in given.books
    )
    given.out.parent.mkdir(parents=True, exist_ok=True)
    given.out.write_text(text, encoding="utf-8")
    print(f"\n{text}\n{given.out}")


def _runs(kind: str, counts: Sequence[int], tools: Path) -> Iterator[Run]:
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        prepared, kept = work / "prepared", work / "kept"
        _build(BUILDERS[0], 1, work / "first", tools, prepared, kind)
        for count in counts:
            for builder in BUILDERS:
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(prepared, kept)
                book = work / f"{builder.title}-{count}"
                cold = _build(builder, count, book, tools, kept, kind)
                edit_line(builder, count, book, "then")
                edited = cost_of(builder.again(tools, book), book, _settings(kept, book))
                yield Run(builder.title, count, cold, edited)
                print(
                    f"{kind}, {builder.title}, {count}: {cold.cpu_s:.1f} s of processor", flush=True
                )
                shutil.rmtree(book)


def _build(builder: Builder, count: int, book: Path, tools: Path, kept: Path, kind: str) -> Cost:
    write_book(builder, count, book, kind)
    return cost_of(builder.command(tools, book), book, _settings(kept, book))


def _settings(kept: Path, book: Path) -> dict[str, str]:
    return {"XDG_CACHE_HOME": str(kept), "PYTHONPATH": str(ROOT), "BOOK": str(book)}


if __name__ == "__main__":
    main()
