"""A new chapter, scene, model, ladder or directive, with its tests: skeletons that work at once."""

import re
from collections.abc import Callable
from pathlib import Path

from site_builder.book import OUTLINE
from site_builder.scaffold.files import filled, packages, write_new
from site_builder.scaffold.names import Name, ScaffoldError, read_name

type Made = tuple[dict[str, str], str]
"""Files by path, and what is to be done next."""


def chapter(root: Path, text: str) -> Made:
    """The next in the order of the book; ``book.toml`` lists it."""
    name = read_name("chapter", text)
    outline = (root / OUTLINE).read_text(encoding="utf-8")
    listed = re.search(r"^chapters\s*=\s*\[(.*?)\]", outline, re.MULTILINE | re.DOTALL)
    if listed is None:
        raise ScaffoldError(f"{OUTLINE} has no list of chapters; legal: chapters = [ … ]")
    there = [file.stem for file in (root / "content").glob("*.md")]
    if name.text in (re.sub(r"^\d+-", "", stem) for stem in there):
        raise ScaffoldError(f"chapter {name.text!r} is there already; legal: another name")
    numbers = [int(stem.partition("-")[0]) for stem in there if stem.partition("-")[0].isdigit()]
    file = f"{max(numbers, default=0) + 1:02}-{name.text}"
    before = listed[1].rstrip()
    comma = "" if not before or before.endswith(",") else ","
    listing = f'chapters = [{before}{comma}\n  "{file}",\n]'
    write_new(root, {f"content/{file}.md": _fill("chapter/chapter.md", name)})
    changed = outline[: listed.start()] + listing + outline[listed.end() :]
    (root / OUTLINE).write_text(changed, encoding="utf-8")
    return {f"content/{file}.md": "", OUTLINE: ""}, f"write it; its place is in {OUTLINE}"


def scene(root: Path, text: str) -> Made:
    name = read_name("scene", text)
    home = f"simulations/scenes/{name.module}/scene.py"
    files = {
        **packages(root, home),
        home: _fill("scene/scene.py", name),
        f"tests/scenes/test_{name.module}_scene.py": _fill("scene/test.py", name),
    }
    _refuse_taken(root, "simulations/scenes", name)
    write_new(root, files)
    return files, f"show it in a chapter, with a caption: :::{{simulation}} {name.text}"


def model(root: Path, text: str) -> Made:
    """``falling`` or, in a room, ``mechanics/falling``."""
    room, _, last = text.rpartition("/")
    name = read_name("model", last)
    rooms = [read_name("room of models", room).module] if room else []
    inner = "/".join([*rooms, name.module])
    home = f"simulations/models/{inner}.py"
    test = "/".join(["tests/models", *rooms, f"test_{name.module}.py"])
    module = ".".join(["", *rooms])[1:]
    files = {
        **packages(root, home),
        home: _fill("model/model.py", name),
        test: _fill("model/test.py", name, path=f"{module}.{name.module}".strip(".")),
    }
    write_new(root, files)
    return files, "let a scene or a ladder ask it"


def ladder(root: Path, text: str) -> Made:
    name = read_name("ladder", text)
    home = f"simulations/ladders/{name.module}.py"
    files = {
        **packages(root, home),
        home: _fill("ladder/ladder.py", name),
        f"tests/ladders/test_{name.module}_ladder.py": _fill("ladder/test.py", name),
    }
    _refuse_taken(root, "simulations/ladders", name)
    write_new(root, files)
    return files, f"make bench LADDER={name.text}; then show it: :::{{ladder}} {name.text}"


def directive(root: Path, text: str) -> Made:
    """In the builder's own folder: a book that shares its engine gives it to all."""
    name = read_name("directive", text)
    rooms = "site_builder/markdown/directives"
    if not (root / rooms).is_dir():
        raise ScaffoldError(f"{root} has no builder of its own; legal: where {rooms}/ is")
    index = root / rooms / "__init__.py"
    listed = index.read_text(encoding="utf-8")
    files = {
        f"{rooms}/{name.module}.py": _fill("directive/directive.py", name),
        f"site_builder/templates/blocks/{name.text}.html": _fill("directive/block.html", name),
        f"site_builder/guide/examples/{name.text}.md": _fill("directive/example.md", name),
        f"tests/builder/markdown/test_{name.module}_directive.py": _fill("directive/test.py", name),
    }
    write_new(root, files)
    index.write_text(_listed(listed, name), encoding="utf-8")
    next_step = f"give it its looks: static/css/{name.text}.css, imported in static/css/book.css"
    return {**files, f"{rooms}/__init__.py": ""}, next_step


def _listed(text: str, name: Name) -> str:
    """The list of directives with one more, imports in their order."""
    line = f"from site_builder.markdown.directives.{name.module} import {name.constant}"
    imports = re.findall(r"^from site_builder\.markdown\.directives\..*$", text, re.MULTILINE)
    whole = "\n".join(imports)
    if whole not in text or "\n)\n" not in text:
        raise ScaffoldError("the list of directives is not as it was; legal: imports, then a tuple")
    ordered = "\n".join(sorted([*imports, line], key=lambda item: item.split(" import ")[0]))
    return text.replace(whole, ordered).replace("\n)\n", f"\n    {name.constant},\n)\n", 1)


def _refuse_taken(root: Path, folder: str, name: Name) -> None:
    for path in (root / folder / name.module, root / folder / f"{name.module}.py"):
        if path.exists():
            message = f"{path.relative_to(root)} is there already; legal: another name"
            raise ScaffoldError(message)


def _fill(template: str, name: Name, **more: str) -> str:
    given = {
        "name": name.text, "module": name.module, "title": name.title, "words": name.words,
        "class": name.class_name, "constant": name.constant,
    }  # fmt: skip
    return filled(f"skeletons/{template}.jinja", **given, **more)


PIECES: dict[str, Callable[[Path, str], Made]] = {
    "chapter": chapter,
    "scene": scene,
    "model": model,
    "ladder": ladder,
    "directive": directive,
}
"""What ``new`` can make in a book."""
