"""Whether each scene, ladder, illustration and table of hard cases is where it is looked for.

They are found by the names of their files (`simulations.registry`). This reads the sources without
running them: each defines its one value, under the id that its name says.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from site_builder.diagnostics import Diagnostics


@dataclass(frozen=True, slots=True)
class Room:
    """A folder of ``simulations`` in which things are found by the names of their files."""

    name: str
    value: str
    """What each of them defines."""
    inside: str = ""
    """The module that defines it in a package; nothing where none may be a package."""
    alone: bool = True
    """Whether a single module may be one."""


ROOMS = (
    Room("scenes", "SCENE", inside="scene", alone=False),
    Room("ladders", "LADDER", inside="ladder"),
    Room("illustrations", "draw"),
    Room("hard_cases", "TABLE"),
)
UNLESS_SHARED = "legal: one, or an underscore before a name that only others use"


def check_declarations(root: Path, problems: Diagnostics) -> None:
    """Report what of the book at ``root`` would not be found, or under another id."""
    for room in ROOMS:
        folder = root / "simulations" / room.name
        taken: dict[str, str] = {}
        for entry in sorted(folder.iterdir()) if folder.is_dir() else ():
            if _is_python(entry) and not entry.stem.startswith(("_", ".")):
                message = _fault_of_place(entry, room, taken)
                if message:
                    problems.add(entry.relative_to(root).as_posix(), 1, message)
                else:
                    _check_values(entry, room, root, problems)
                taken.setdefault(entry.stem, entry.name)


def _is_python(entry: Path) -> bool:
    return entry.suffix == ".py" if entry.is_file() else any(entry.glob("*.py"))


def _fault_of_place(entry: Path, room: Room, taken: dict[str, str]) -> str:
    """What is wrong with where it lies, or nothing."""
    if entry.stem in taken:
        return f"{taken[entry.stem]} has that name; legal: another one"
    if not entry.is_dir() and not room.alone:
        return f"a module among packages; legal: {entry.stem}/{room.inside}.py"
    if entry.is_dir() and not room.inside:
        return f"a package among modules; legal: {entry.name}.py"
    if entry.is_dir() and not (entry / "__init__.py").is_file():
        return "a folder that is no package; legal: an empty __init__.py in it"
    return ""


def _check_values(entry: Path, room: Room, root: Path, problems: Diagnostics) -> None:
    """One value, in the right module, of the right id."""
    home = entry / f"{room.inside}.py" if entry.is_dir() else entry
    files = sorted(entry.rglob("*.py")) if entry.is_dir() else [entry]
    try:
        found = [(file, node) for file in files for node in _definitions(file, room.value)]
    except (SyntaxError, ValueError):
        return  # told where a page asks for it
    if all(file != home for file, _ in found):
        place = (home if home.is_file() else entry).relative_to(root).as_posix()
        where = "" if home.is_file() else f" in {home.name}"
        problems.add(place, 1, f"no {room.value}{where}; {UNLESS_SHARED}")
    right = next((item for item in found if item[0] == home), None)
    for file, node in found:
        path = file.relative_to(root).as_posix()
        if (file, node) != right:
            problems.add(path, node.lineno, f"a {room.value} too many; legal: one, in {home.name}")
        elif given := _id_of(node):
            expected = entry.stem.replace("_", "-")
            if given.value != expected:
                problems.add(
                    path, given.lineno, f"id {given.value!r} in {home.name}; legal: {expected!r}"
                )


def _definitions(file: Path, name: str) -> Iterator[ast.stmt]:
    """Where a module defines ``name`` at its top level."""
    for statement in ast.parse(file.read_bytes()).body:
        match statement:
            case (
                ast.Assign(targets=[ast.Name(id=defined)])
                | ast.AnnAssign(target=ast.Name(id=defined))
                | ast.FunctionDef(name=defined)
            ) if defined == name:
                yield statement


def _id_of(statement: ast.stmt) -> ast.Constant | None:
    """The id that a value is given, where it stands there as text."""
    match statement:
        case (
            ast.Assign(value=ast.Call(args=arguments, keywords=keywords))
            | ast.AnnAssign(value=ast.Call(args=arguments, keywords=keywords))
        ):
            named = [keyword.value for keyword in keywords if keyword.arg == "id"]
            for given in (*named, *arguments[:1]):
                if isinstance(given, ast.Constant) and isinstance(given.value, str):
                    return given
    return None
