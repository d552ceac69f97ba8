"""What authors' code may not do while a book is built, as it could not do it in a page: open files
and addresses, write, and start programs.

CPython tells of these as audit events (PEP 578). That is no defence against an attacker, who runs
as the author does; it shows mistakes at their lines.
"""

import os
import sys
import sysconfig
from importlib.machinery import all_suffixes
from pathlib import Path

import simulations
from site_builder.files.engine import HERE
from site_builder.files.folders import data_of

EXPECTED = "legal: what the model computes"
DATA = "legal: a file beside the module that reads it, named there, as in with_name('data.csv')"
REFUSED = {
    "socket.connect": "connects to an address",
    "socket.bind": "opens a port",
    "socket.getaddrinfo": "looks up an address",
    "subprocess.Popen": "starts a program",
    "pty.spawn": "starts a program",
    **dict.fromkeys(("os.system", "os.exec", "os.posix_spawn", "os.spawn"), "starts a program"),
    **dict.fromkeys(("os.fork", "os.forkpty"), "starts a process"),
    "os.remove": "deletes a file",
    "os.rmdir": "deletes a folder",
    "shutil.rmtree": "deletes a folder",
    "os.mkdir": "makes a folder",
    "os.rename": "renames a file",
    "os.truncate": "shortens a file",
    **dict.fromkeys(("os.link", "os.symlink"), "makes a link"),
    **dict.fromkeys(
        ("os.chmod", "os.chown", "os.chflags", "os.utime", "os.setxattr", "os.removexattr"),
        "changes a file",
    ),
}
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
SYSTEM = ("/dev", "/proc", "/sys", "/etc/localtime", "/usr/share/zoneinfo")
"""What libraries read."""
COMPILED = "__pycache__"
MODULES = tuple(all_suffixes())


def raise_fence() -> None:
    """Confine the process from now on until it ends."""
    installed = [folder for folder in sys.path if "-packages" in folder]
    paths = (sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib"))
    libraries = _real(*installed, *paths, str(HERE), *SYSTEM)
    books = _real(*sys.path, *(os.path.dirname(folder) for folder in simulations.__path__))  # noqa: PTH120

    def watch(event: str, given: tuple[object, ...]) -> None:
        if event == "open":
            _check_file(given, libraries, books)
        elif event in REFUSED:
            names = [each for each in given if isinstance(each, str | bytes | os.PathLike | tuple)]
            if not names or not all(map(_is_compiled, names)):
                what = f": {names[0]!r}" if names else ""
                raise PermissionError(f"{REFUSED[event]}{what}; {EXPECTED}")

    sys.addaudithook(watch)


def _real(*folders: str) -> tuple[str, ...]:
    return tuple(sorted({os.path.realpath(folder) for folder in folders if folder}))


def _is_compiled(path: object) -> bool:
    """Whether Python itself keeps byte code there."""
    if not isinstance(path, str | bytes | os.PathLike):
        return False
    file = Path(os.fsdecode(path))
    return COMPILED in (file.name, file.parent.name)


def _check_file(
    given: tuple[object, ...], libraries: tuple[str, ...], books: tuple[str, ...]
) -> None:
    """Only modules of the book's may be read, and the data beside them that they name, as pages
    have nothing else of it."""
    path, _mode, flags = given
    if isinstance(path, int) or _is_compiled(path):
        return
    file = os.path.realpath(os.fsdecode(path))  # type: ignore[arg-type]
    if isinstance(flags, int) and flags & WRITING and not file.startswith("/dev/"):
        raise PermissionError(f"writes {file!r}; {EXPECTED}")
    legal = (*libraries, *books) if file.endswith(MODULES) else libraries
    if not any(Path(file).is_relative_to(folder) for folder in legal) and not _travels(file):
        raise PermissionError(f"reads {file!r}; {DATA}")


def _travels(file: str) -> bool:
    """Whether a module of simulations takes it along."""
    for folder in simulations.__path__:
        places = [
            each for each in Path(file).parents if each.is_relative_to(os.path.realpath(folder))
        ]
        modules = [module for place in places for module in place.glob("*.py")]
        if any(
            file == os.path.realpath(data) for each in modules for data in data_of(each).values()
        ):
            return True
    return False
