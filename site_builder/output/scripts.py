"""The scripts of pages, and the code editor: TypeScript, bundled by esbuild into few files."""

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from posixpath import normpath

from site_builder.cache.results import cached_result
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.files.folders import file_hash
from site_builder.languages.words import Words
from site_builder.output.writer import Content, content_bytes, content_hash
from site_builder.programs.node import NodeError, Package, installed_packages, run_node
from site_builder.settings.model import Settings, storage_prefix

STYLE = "style."
"""Begins the keys of the texts in the style sheet."""


def book_css(words: Words) -> str:
    """A rule for the end of the style sheet, with its words."""
    texts = {key.removeprefix(STYLE): words(key) for key in words.texts if key.startswith(STYLE)}
    # CSS takes the strings of JSON but for escapes of control characters, which no text has.
    rules = (
        f"  --word-{name}: {json.dumps(text, ensure_ascii=False)};\n"
        for name, text in texts.items()
    )
    return f"\n:root {{\n{''.join(rules)}}}\n"


def book_script(settings: Settings, words: Words) -> bytes:
    """The module ``js/book.js``, which all scripts import; ``.ci/web/book.d.ts`` has its types."""
    exports = {
        "STORAGE": f"{storage_prefix(settings)}:",
        "DECIMAL": words("language.decimal"),
        "WORDS": words.of_scripts,
    }
    lines = (
        f"export const {name} = {json.dumps(value, ensure_ascii=False)};\n"
        for name, value in exports.items()
    )
    return "".join(lines).encode()


DRIVER = Path(__file__).with_name("bundle_scripts.mjs")
PACKAGES = Path(__file__).parents[1] / "editor"
"""The folder of the code editor, whose packages have esbuild."""


@dataclass(frozen=True, slots=True)
class Bundle:
    """What the scripts of a page have become."""

    files: Mapping[str, bytes]
    at_once: tuple[str, ...]
    """The files that the entry imports, itself or through others: nearest first. Named in
    the head of a page, they are fetched side by side and not in a chain."""
    beside: frozenset[str]
    """Files that scripts name by ``new URL("…", import.meta.url)``."""


def bundle_scripts(sources: Mapping[str, Content], entry: str, *others: str) -> Bundle:
    """The module ``entry`` of these ``sources`` with what it imports; what it imports later, the
    workers that it starts, and the ``others`` are files of their own.

    Sources are named by their paths from ``static/``, so that imports lead where they do in the
    repository. Each file is named as its source, with ``.js`` in place of ``.ts``; what several
    share has a hash in its name.

    Raises
    ------
    BuildError
        For what does not fit together, by file and line; or where esbuild cannot be had.
    """
    given = [(name, content_hash(sources[name])) for name in sorted(sources)]
    tool = [file_hash(path) for path in (DRIVER, PACKAGES / "package-lock.json")]
    made_of = (entry, others, given, tool)
    return cached_result("scripts", made_of, lambda: _bundle(sources, entry, others))


def _bundle(sources: Mapping[str, Content], entry: str, others: tuple[str, ...]) -> Bundle:
    with tempfile.TemporaryDirectory() as scratch:
        given, out = Path(scratch).resolve() / "static", Path(scratch).resolve() / "out"
        out.mkdir()
        for name, content in sources.items():
            (given / name).parent.mkdir(parents=True, exist_ok=True)
            (given / name).write_bytes(content_bytes(content))
        try:
            places = [str(place) for place in (installed_packages(PACKAGES), given, out)]
            run_node([str(DRIVER), *places, entry, *others], given)
        except NodeError as error:
            message = f"cannot bundle the scripts of pages: {error}"
            raise BuildError([Diagnostic(f"static/{entry}", 1, message)]) from None
        result = json.loads((out / "bundle.json").read_text(encoding="utf-8"))
        if result["errors"]:
            raise BuildError(
                Diagnostic(normpath(f"static/{error['path']}"), error["line"], error["text"])
                for error in result["errors"]
            )
        files = {
            file.relative_to(out).as_posix(): file.read_bytes()
            for file in sorted(out.rglob("*.js"))
        }
    return Bundle(files, tuple(result["at_once"]), frozenset(result["beside"]))


INGREDIENTS = ("package.json", "package-lock.json", "bundle.mjs", "code_editor.ts")


@dataclass(frozen=True, slots=True)
class EditorBundle:
    """The code editor; without a script where it could not be made."""

    script: bytes = b""
    packages: tuple[Package, ...] = ()


def bundle_editor() -> EditorBundle:
    """Raises `NodeError` where its packages cannot be had."""
    return cached_result("editor", [file_hash(PACKAGES / name) for name in INGREDIENTS], _editor)


def _editor() -> EditorBundle:
    with tempfile.TemporaryDirectory() as out:
        run_node([str(PACKAGES / "bundle.mjs"), str(installed_packages(PACKAGES)), out], PACKAGES)
        script = (Path(out) / "code_editor.js").read_bytes()
        packages = json.loads((Path(out) / "packages.json").read_bytes())
    return EditorBundle(script, tuple(Package(**item) for item in packages))
