"""A new book in a folder of its own, with a copy of the engine inside."""

import subprocess
import tomllib
from pathlib import Path

from site_builder.book_root import ENGINE, ENGINE_PARTS
from site_builder.scaffold.files import HERE, SUFFIX, filled
from site_builder.scaffold.names import ScaffoldError, read_name

TOOLS = (
    ".github/workflows/publish.yml",
    ".locks/author.txt",
    ".locks/book.txt",
    ".python-version",
    "simulations/__init__.py",
    "tests/bench/__main__.py",
    "tests/bench/browser_side.py",
    "tests/bench/record.py",
    "tests/support/chromium.py",
    "tests/support/scripts.py",
    "tests/support/static_server.py",
)
"""What every book needs besides the engine: pins, the bench, and a way to publish."""
LEFT_OUT = ("__pycache__", "node_modules")


def make_book(folder: Path) -> list[str]:
    """Write a working book into ``folder``, which must be empty or not there; its files by path.

    Raises `ScaffoldError`.
    """
    name = read_name("book", folder.resolve().name)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ScaffoldError(f"{folder} is not empty; legal: a folder that is empty or not there")
    project = tomllib.loads((ENGINE / "pyproject.toml").read_text(encoding="utf-8"))
    given = {
        "name": name.text,
        "title": name.title,
        "engine": _version(project["project"]["version"]),
        "licence": _licence(),
        "numpy": project["project"]["dependencies"],
        "groups": {group: project["dependency-groups"][group] for group in ("book", "author")},
    }
    files = {path: (ENGINE / path).read_bytes() for path in _engine_files()}
    for template in sorted((HERE / "book").rglob("*")):
        if template.is_file():
            path = template.relative_to(HERE / "book").as_posix()
            text = filled(f"book/{path}", **given) if path.endswith(SUFFIX) else None
            data = template.read_bytes() if text is None else text.encode()
            files[path.removesuffix(SUFFIX).replace("dot-", ".")] = data
    for path, data in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)
    return sorted(files)


def _engine_files() -> list[str]:
    """Builder, templates, scripts, style sheets, and the engine's parts of ``simulations``."""
    parts = [f"simulations/{part}" for part in ENGINE_PARTS]
    folders = ["site_builder", "static", *(part for part in parts if (ENGINE / part).is_dir())]
    files = [f"{part}.py" for part in parts if not (ENGINE / part).is_dir()]
    for folder in folders:
        for file in sorted((ENGINE / folder).rglob("*")):
            path = file.relative_to(ENGINE)
            if file.is_file() and not set(path.parts) & set(LEFT_OUT) and file.suffix != ".pyc":
                files.append(path.as_posix())
    return [*files, *TOOLS]


def _licence() -> str:
    """The engine's: what stands in ``LICENSE`` from the licence's own name on."""
    text = (ENGINE / "LICENSE").read_text(encoding="utf-8")
    return text[text.index("MIT License\n") :].rstrip()


def _version(declared: str) -> str:
    """With the commit, where it is known."""
    command = ["git", "-C", str(ENGINE), "rev-parse", "--short", "HEAD"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return declared
    return f"{declared} ({done.stdout.strip()})" if done.returncode == 0 else declared
