"""``python -m scale --tools BIN [--chapters 10 100 1000]``: builders compared, on one text.

Each builds the same book in the same run: cold, and again after one edited line. What this
builder keeps between builds is filled by a book of one chapter first, which fetches and cuts what
any book needs, and put back so before every cold build.
"""

import argparse
import shutil
import tempfile
from pathlib import Path

from scale.cost import Cost, cost_of
from scale.report import Run, report
from scale.trees import BUILDERS, Builder, edit_line, write_book

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    parser = argparse.ArgumentParser(prog="scale", description=__doc__)
    parser.add_argument("--tools", type=Path, required=True, help="where mkdocs and Sphinx are")
    parser.add_argument("--chapters", type=int, nargs="+", default=[10, 100, 1000])
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "scale.md")
    given = parser.parse_args()
    tools = given.tools.resolve()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        prepared = work / "prepared"
        _build(BUILDERS[0], 1, work / "first", tools, prepared)
        runs = []
        for count in given.chapters:
            for builder in BUILDERS:
                kept = work / "kept"
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(prepared, kept)
                book = work / f"{builder.title}-{count}"
                cold = _build(builder, count, book, tools, kept)
                edit_line(builder, count, book, "then")
                edited = cost_of(builder.again(tools, book), book, _settings(kept, book))
                runs.append(Run(builder.title, count, cold, edited))
                print(f"{builder.title}, {count}: {cold.cpu_s:.1f} s of processor", flush=True)
                shutil.rmtree(book)
    text = report(runs)
    given.out.parent.mkdir(parents=True, exist_ok=True)
    given.out.write_text(text, encoding="utf-8")
    print(f"\n{text}\n{given.out}")


def _build(builder: Builder, count: int, book: Path, tools: Path, kept: Path) -> Cost:
    write_book(builder, count, book)
    return cost_of(builder.command(tools, book), book, _settings(kept, book))


def _settings(kept: Path, book: Path) -> dict[str, str]:
    return {"XDG_CACHE_HOME": str(kept), "PYTHONPATH": str(ROOT), "BOOK": str(book)}


if __name__ == "__main__":
    main()
