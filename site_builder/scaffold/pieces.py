"""A new book, in a folder of its own; a new chapter, scene, model, or ladder, with tests."""

import json
import keyword
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import distribution
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from site_builder.benchmarks.measurements import COMMAND
from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.book import OUTLINE
from site_builder.files.engine import DISTRIBUTION, ENGINE, PACKED, SHARED, book_or_engine_file
from site_builder.files.folders import replace_files
from site_builder.version import __version__

FORM = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


class ScaffoldError(ValueError):
    """Something new cannot be made."""


@dataclass(frozen=True, slots=True)
class Name:
    """``falling-ball``: lower case, with hyphens."""

    text: str

    @property
    def module(self) -> str:
        return self.text.replace("-", "_")

    @property
    def constant(self) -> str:
        return self.module.upper()

    @property
    def title(self) -> str:
        return " ".join(word.capitalize() for word in self.text.split("-"))


def read_name(kind: str, text: str) -> Name:
    """Raises `ScaffoldError`."""
    if not FORM.fullmatch(text):
        expected = "small letters and digits, with hyphens between words, as in 'falling-ball'"
        raise ScaffoldError(f"{kind} {text!r}; legal: {expected}")
    if keyword.iskeyword(text):
        raise ScaffoldError(f"{kind} {text!r} is a word of Python's own; legal: any other name")
    return Name(text)


HERE = Path(__file__).parent
SUFFIX = ".jinja"


def filled(template: str, **given: object) -> str:
    """A template of this folder, by its path, with what stands between « and » filled in."""
    return _environment().get_template(template).render(given)


@cache
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(HERE),
        variable_start_string="«",
        variable_end_string="»",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
        undefined=StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )


def write_new(
    root: Path, files: Mapping[str, str], changed: Mapping[str, str] = MappingProxyType({})
) -> None:
    """Write new ``files``, by their paths below ``root``, and others that are ``changed``. Raises
    `ScaffoldError` where a new one is there."""
    there = [path for path in files if (root / path).exists()]
    if there:
        raise ScaffoldError(f"{', '.join(there)} is there already; legal: a name that is not taken")
    replace_files({root / path: text.encode() for path, text in {**files, **changed}.items()})


def packages(root: Path, module: str) -> dict[str, str]:
    """An empty ``__init__.py`` for each folder around ``module`` that lacks one, but for those that
    a book and the engine share."""
    folders = [folder.as_posix() for folder in Path(module).parents]
    paths = [f"{folder}/__init__.py" for folder in folders if folder not in (".", *SHARED)]
    return {path: "" for path in paths if not (root / path).exists()}


WORKFLOW = ".github/workflows/publish.yml"
"""Publishes this repository's book, and any other."""


def make_book(folder: Path) -> list[str]:
    """Write a working book into ``folder``, which must be empty or not there; its files by path.

    Raises `ScaffoldError`.
    """
    name = read_name("book", folder.resolve().name)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ScaffoldError(f"{folder} is not empty; legal: a folder that is empty or not there")
    engine, wheels = _engine()
    given = {"name": name.text, "title": name.title, "engine": engine, "version": __version__}
    files = {
        **wheels,
        ".python-version": f"{sys.version_info.major}.{sys.version_info.minor}\n".encode(),
        WORKFLOW: book_or_engine_file(ENGINE, WORKFLOW).read_bytes(),
    }
    for template in sorted((HERE / "book").rglob("*")):
        if template.is_file():
            path = template.relative_to(HERE / "book").as_posix()
            text = filled(f"book/{path}", **given) if path.endswith(SUFFIX) else None
            data = template.read_bytes() if text is None else text.encode()
            files[path.removesuffix(SUFFIX).replace("dot-", ".")] = data
    replace_files({folder / path: data for path, data in files.items()})
    return sorted(files)


def _engine() -> tuple[str, dict[str, bytes]]:
    """The engine that runs, as pip reads it, and its wheel where it came from a file or a folder:
    a book is then whole on other machines too. Raises `ScaffoldError`."""
    address = ENGINE.as_uri()
    if PACKED.is_dir():
        origin = distribution(DISTRIBUTION).read_text("direct_url.json")
        if origin is None:
            return f"{DISTRIBUTION}=={__version__}", {}
        found = json.loads(origin)
        vcs, address = found.get("vcs_info"), found["url"]
        if vcs:
            address = f"{vcs['vcs']}+{address}@{vcs['commit_id']}"
    if not address.startswith("file:"):
        return f"{DISTRIBUTION} @ {address}", {}
    pip = (sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check")
    with TemporaryDirectory() as folder:
        command = (*pip, "--no-deps", "--wheel-dir", folder, address)
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise ScaffoldError(f"the engine's wheel cannot be made: {done.stderr.strip()}")
        wheels = {f"engine/{file.name}": file.read_bytes() for file in Path(folder).iterdir()}
    return DISTRIBUTION, wheels


type Made = tuple[dict[str, str], str]
"""Files by path, and what is to be done next."""


def chapter(root: Path, text: str) -> Made:
    """The next in the order of the book; ``book.toml`` lists it."""
    name = read_name("chapter", text)
    outline = (root / OUTLINE).read_text(encoding="utf-8")
    listed = re.search(r"^chapters\s*=\s*\[(.*?)\]", outline, re.MULTILINE | re.DOTALL)
    if listed is None:
        raise ScaffoldError(f"{OUTLINE} has no list of chapters; legal: chapters = [ … ]")
    there = [file.stem for file in (root / "content").glob("[!.#]*.md")]
    if name.text in (re.sub(r"^\d+-", "", stem) for stem in there):
        raise ScaffoldError(f"chapter {name.text!r} is there already; legal: another name")
    numbers = [int(stem.partition("-")[0]) for stem in there if stem.partition("-")[0].isdigit()]
    file = f"{max(numbers, default=0) + 1:02}-{name.text}"
    before = listed[1].rstrip()
    comma = "" if not before or before.endswith(",") else ","
    listing = f'chapters = [{before}{comma}\n  "{file}",\n]'
    changed = outline[: listed.start()] + listing + outline[listed.end() :]
    write_new(root, {f"content/{file}.md": _fill("chapter/chapter.md", name)}, {OUTLINE: changed})
    return {f"content/{file}.md": "", OUTLINE: ""}, f"write it; its place is in {OUTLINE}"


GALLERY = tuple(
    file.name.partition(".")[0] for file in sorted((HERE / "skeletons" / "gallery").glob("*.jinja"))
)
"""Figures to begin with, which the guide shows."""


def from_gallery(like: str) -> str:
    """The source of a figure of the gallery."""
    return _fill(f"gallery/{like}.py", Name(like))


def scene(root: Path, text: str, like: str = "moving-point") -> Made:
    """A figure of the gallery under another name."""
    name = read_name("scene", text)
    _refuse_taken(root, "simulations/scenes", name)
    if like not in GALLERY:
        raise ScaffoldError(unknown("figure of the gallery", like, GALLERY))
    files = {
        f"simulations/scenes/{name.module}.py": f"gallery/{like}.py",
        f"tests/scenes/test_{name.module}_scene.py": "scene/test.py",
    }
    made = _write(root, name, files)
    return made, f"show it in a chapter, with a caption: :::{{simulation}} {name.text}"


def model(root: Path, text: str) -> Made:
    """``falling`` or, in a folder, ``mechanics/falling``."""
    folder, _, last = text.rpartition("/")
    name = read_name("model", last)
    folders = [read_name("folder of models", folder).module] if folder else []
    files = {
        "/".join(["simulations/models", *folders, f"{name.module}.py"]): "model/model.py",
        "/".join(["tests/models", *folders, f"test_{name.module}.py"]): "model/test.py",
    }
    made = _write(root, name, files, path=".".join([*folders, name.module]))
    table = "tests/properties/arguments.toml"  # where a book has one
    row = f"add its function to {table}; then " if (root / table).is_file() else ""
    return made, f"{row}use it in a scene or a ladder"


def ladder(root: Path, text: str) -> Made:
    name = read_name("ladder", text)
    _refuse_taken(root, "simulations/ladders", name)
    files = {
        f"simulations/ladders/{name.module}.py": "ladder/ladder.py",
        f"tests/ladders/test_{name.module}_ladder.py": "ladder/test.py",
    }
    made = _write(root, name, files)
    measure = f"{COMMAND} --ladder {name.text}"
    return made, f"{measure}; then show it: :::{{ladder}} {name.text}"


def _write(root: Path, name: Name, templates: Mapping[str, str], **more: str) -> dict[str, str]:
    """Write the files, with packages around the first, each from its template."""
    home = next(iter(templates))
    filled_in = {path: _fill(template, name, **more) for path, template in templates.items()}
    files = {**(packages(root, home) if home.startswith("simulations/") else {}), **filled_in}
    write_new(root, files)
    return files


def _refuse_taken(root: Path, folder: str, name: Name) -> None:
    for path in (root / folder / name.module, root / folder / f"{name.module}.py"):
        if path.exists():
            message = f"{path.relative_to(root)} is there already; legal: another name"
            raise ScaffoldError(message)


def _fill(template: str, name: Name, **more: str) -> str:
    given = {
        "name": name.text, "words": name.text.replace("-", " "), "module": name.module,
        "title": name.title, "class": name.title.replace(" ", ""), "constant": name.constant,
    }  # fmt: skip
    return filled(f"skeletons/{template}.jinja", **given, **more)


PIECES: dict[str, Callable[[Path, str], Made]] = {
    "chapter": chapter,
    "scene": scene,
    "model": model,
    "ladder": ladder,
}
"""What ``new`` can make in a book."""


def make_new(root: Path, kind: str, name: str, like: str = "") -> str:
    """Make a book or a piece of one, a scene ``like`` one of the gallery. Returns a summary and
    the next step. Raises `ScaffoldError`."""
    if kind == "book":
        files = make_book(Path(name))
        return f"{name}: {len(files)} files\nnext: cd {shlex.quote(name)} && make serve"
    if like and kind != "scene":
        raise ScaffoldError(f"a {kind} like {like!r}; legal: a scene")
    made, after = scene(root, name, like) if like else PIECES[kind](root, name)
    return "\n".join([*made, f"next: {after}"])
