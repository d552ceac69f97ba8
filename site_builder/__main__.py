"""The command line: ``python -m site_builder COMMAND``; ``--help`` lists the commands."""

import argparse
import gc
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from simulations.registry import LADDER_MODULES
from site_builder.assets.browser_parts import pack_for_browser
from site_builder.build import Options, Warn, build_site, check_site, ignore
from site_builder.cache.hashing import source_hash
from site_builder.cache.results import Cache, using
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic, as_json, counted
from site_builder.diagnostics.progress import say, show_progress
from site_builder.document.book import Book
from site_builder.files.engine import engine_version
from site_builder.files.folders import folder_hash, replace_file
from site_builder.output.writer import advice, write_site
from site_builder.photographs import prepare_photographs
from site_builder.pool.loading import read_figures
from site_builder.pool.processes import using_pool
from site_builder.settings.declared import site_address, source_address

ROOT = Path.cwd()
"""The book's folder."""
NEW = ("book", "chapter", "scene", "model", "ladder")
"""What ``new`` makes."""


def main(arguments: list[str] | None = None) -> int:
    """0 where the book is in order, 1 where it is not, 130 where the reader interrupted.

    Warnings are printed and change nothing else.
    """
    given = _parser().parse_args(arguments)
    anywhere = given.command == "guide" or (given.command == "new" and given.kind == "book")
    if not (anywhere or (ROOT / "content").is_dir()):
        print(f"{ROOT} is no book; legal: a folder that holds content/", file=sys.stderr)
        return 1
    warnings: list[Diagnostic] = []

    def warn(warning: Diagnostic) -> None:
        warnings.append(warning)
        say(str(warning), sys.stderr)

    show_progress(sys.stderr)
    try:
        prepare_photographs(ROOT)
        with using(Cache()), using_pool():
            return _run(given, warn, warnings)
    except BuildError as error:
        print(error, file=sys.stderr)
        mistakes = counted(error.diagnostics, "mistake")
        print(f"{mistakes}; nothing was written", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"{error}{advice(error)}", file=sys.stderr)
        return 1
    except (ValueError, RuntimeError) as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


def _run(given: argparse.Namespace, warn: Warn, warnings: Sequence[Diagnostic]) -> int:
    """The command's number where nothing was raised."""
    match given.command:
        case "build":
            if given.bar is not None:
                show_progress(os.fdopen(given.bar, "w", encoding="utf-8"))
            options = Options(
                root=ROOT, runtime=given.runtime, reload=given.reload, warn=warn,
                address=site_address(given.address), source=source_address(given.source),
            )  # fmt: skip
            if given.wait:
                source_hash("site_builder.build")  # cached, for when a line comes
                read_figures()
                for folder in (ROOT / "content", ROOT / "simulations", given.out):
                    folder_hash(folder)  # of files that will not have changed by then
                with suppress(BuildError, OSError, ValueError, RuntimeError):  # reported then
                    check_site(replace(options, warn=ignore))  # cached too
                if not sys.stdin.readline():
                    return 0  # the server has ended
            files = build_site(options, given.out)
            warned = f"; {counted(warnings, 'warning')}" if warnings else ""
            print(f"{given.out}: {len(files)} files{warned}")
        case "check":
            return check(Options(root=ROOT, runtime=given.runtime), json=given.json)
        case "new":
            from site_builder.scaffold.pieces import make_new  # needed only here

            print(make_new(ROOT, given.kind, given.name, given.like))
        case "pdf" | "epub":
            # Readers of pages and printers are needed only here.
            from site_builder.editions.compose import compose
            from site_builder.editions.epub import make_epub
            from site_builder.editions.pdf import make_pdf, pdf_printer

            printer = pdf_printer() if given.command == "pdf" else None  # before all the work
            composed = compose(Options(root=ROOT, runtime=False, warn=warn))
            edition = make_pdf(composed, printer) if printer else make_epub(composed, ROOT)
            written(given.out or _edition(composed.book, given.command), edition)
        case "notebooks":
            from site_builder.editions.notebooks.notebook import REQUIREMENTS, make_notebooks

            address = site_address(given.address)
            checked = check_site(Options(root=ROOT, runtime=False, warn=warn, address=address))
            write_site(make_notebooks(checked, ROOT), given.out, known_by=REQUIREMENTS)
            print(f"{given.out}: {len(checked.book.chapters)} notebooks")
        case "questions":
            from site_builder.editions.questions import count_not_exported, make_moodle, make_qti

            address = site_address(given.address)
            book = check_site(Options(root=ROOT, runtime=False, warn=warn, address=address)).book
            written(_edition(book, "moodle.xml"), make_moodle(book))
            written(_edition(book, "qti.zip"), make_qti(book))
            if count := count_not_exported(book):
                print(f"{count} questions about figures are left out; they need --address")
        case "bench":
            from site_builder.assets.page_assets import write_scripts
            from site_builder.benchmarks.measuring import bench, measure_errors

            if given.errors:
                return measure_errors(ROOT, given.ladder)
            return bench(ROOT, given.ladder, write_scripts)
        case "guide":
            from site_builder.guide.generator import run_guide

            place = None if given.build_only else (given.host, given.port)
            return run_guide(place, runtime=given.runtime)
        case "serve":
            from site_builder.server.command import serve  # its watcher is needed only here

            serve(ROOT, given.out, given.port, runtime=given.runtime, host=given.host)
    return 0


def check(options: Options, *, json: bool) -> int:
    """Print all mistakes and warnings; return 1 where there is a mistake, else 0.

    Text goes to the standard error, as the build's does, and JSON to the standard output.
    """
    found = find(options)
    warnings = [one for one in found if not one.fails]
    mistakes = [one for one in found if one.fails]
    if json:
        sys.stdout.write(as_json(found, options.root))
        return int(bool(mistakes))
    for one in [*warnings, *mistakes]:
        print(one, file=sys.stderr)
    if mistakes:
        print(f"{counted(mistakes, 'mistake')}; nothing was written", file=sys.stderr)
        return 1
    print("no mistakes" + (f"; {counted(warnings, 'warning')}" if warnings else ""))
    return 0


def find(options: Options) -> Sequence[Diagnostic]:
    """Mistakes and warnings in the order of files and lines."""
    found: list[Diagnostic] = []
    try:
        book, *_ = check_site(replace(options, warn=found.append))
        if options.runtime:
            pack_for_browser(options.root, book, found.append, compiled=False)
    except BuildError as error:
        found += error.diagnostics
    return sorted(set(found))


def _edition(book: Book, kind: str) -> Path:
    """``build/the-book-s-title.pdf``."""
    from site_builder.markdown.numbering import slug

    return ROOT / "build" / f"{slug(book.title)}.{kind}"


def written(out: Path, edition: bytes) -> None:
    replace_file(out, edition)
    print(f"{out}: {len(edition) / 1e6:.1f} MB")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="site_builder", description="Build the book.")
    parser.add_argument("--version", action="version", version=f"%(prog)s {engine_version()}")
    commands = parser.add_subparsers(dest="command", required=True)

    def add(name: str, purpose: str, *options: argparse.ArgumentParser) -> argparse.ArgumentParser:
        return commands.add_parser(name, help=purpose, parents=options)

    out, runtime, place = (argparse.ArgumentParser(add_help=False) for _ in range(3))
    out.add_argument("--out", type=Path, default=ROOT / "build" / "site", help="the site")
    runtime.add_argument(
        "--no-runtime", dest="runtime", action="store_false", help="leave out Python: stills only"
    )
    place.add_argument("--port", type=int, default=8000)
    everyone = "address to listen at; 0.0.0.0 for everyone on the network"
    place.add_argument("--host", default="127.0.0.1", help=everyone)

    build = add("build", "check everything, then write the site", out, runtime)
    for name, does in (("--reload", "pages reload themselves"), ("--wait", "begin after a line")):
        build.add_argument(name, action="store_true", help=f"for `serve`: {does}")
    build.add_argument("--bar", type=int, help="for `serve`: file descriptor of its terminal")
    build.add_argument("--address", default="", help="where the site will be")
    build.add_argument("--source", default="", help="where its sources are, with {path} in it")
    add("serve", "build, show, and build again on every change", out, runtime, place)
    check = add("check", "report the mistakes in the sources", runtime)
    check.add_argument("--json", action="store_true", help="for editors and programs")
    guide = add("guide", "show the guide for authors, a book of its own", runtime, place)
    guide.add_argument("--build-only", action="store_true", help="do not serve it")
    bench = add("bench", "time and judge the ladders, here and in Chromium")
    bench.add_argument("--ladder", action="append", choices=[*LADDER_MODULES], default=[])
    bench.add_argument("--errors", action="store_true", help="compute the errors, keep the times")
    new = add("new", "make a book, or a skeleton in this one, with its tests")
    new.add_argument("kind", choices=NEW)
    new.add_argument("name", help="such as falling-ball; of a book, its folder")
    new.add_argument("--like", default="", help="for a scene: a figure of the guide's gallery")
    for name, purpose in (
        ("pdf", "set the whole book on pages; needs Chromium"),
        ("epub", "pack the whole book for a reader of e-books"),
    ):
        add(name, purpose).add_argument("--out", type=Path, help="the file")
    address = argparse.ArgumentParser(add_help=False)
    address.add_argument("--address", default="", help="where the site is, for links to it")
    add("questions", "export the questions, as Moodle XML and as QTI 2.1", address)
    notebooks = add("notebooks", "make each chapter a Jupyter notebook", address)
    folder = ROOT / "build" / "notebooks"
    notebooks.add_argument("--out", type=Path, default=folder, help="the folder")
    return parser


if __name__ == "__main__":
    for stream in ("stdout", "stderr"):
        if getattr(sys, stream) is None:  # closed by what started the command
            setattr(sys, stream, open(os.devnull, "w"))  # noqa: PTH123, SIM115
    gc.set_threshold(100_000)  # a build makes many objects that stay, and few cycles
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # the system frees a book's objects sooner than Python does, one by one
