"""What authors' code may not do while a book is built, as it could not do it in a page: open files
and addresses, write, and start programs.

CPython tells of these as audit events (PEP 578). That is no defence against an attacker, who runs
as the author does; it shows mistakes at their lines.
"""

import os
import sys
from pathlib import Path

import simulations

EXPECTED = "legal: what the model computes; data as modules in simulations/"
REFUSED = {
    "socket.connect": "connects to an address",
    "socket.bind": "opens a port",
    "socket.getaddrinfo": "looks up an address",
    "subprocess.Popen": "starts a program",
    "os.system": "starts a program",
    "os.exec": "starts a program",
    "os.posix_spawn": "starts a program",
    "os.fork": "starts a process",
    "os.remove": "deletes a file",
    "os.rmdir": "deletes a folder",
    "shutil.rmtree": "deletes a folder",
}
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
SYSTEM = ("/dev", "/proc", "/sys", "/etc/localtime", "/usr/share/zoneinfo")
"""What libraries read."""
COMPILED = "__pycache__"


def raise_fence() -> None:
    """Confine the process from now on until it ends."""
    books = (os.path.dirname(folder) for folder in simulations.__path__)  # noqa: PTH120
    folders = {*sys.path, *books, sys.prefix, sys.base_prefix, *SYSTEM}
    legal = tuple(sorted({os.path.realpath(folder) for folder in folders if folder}))

    def watch(event: str, given: tuple[object, ...]) -> None:
        if event == "open":
            _check_file(given, legal)
        elif event in REFUSED and COMPILED not in str(given):
            what = given[1] if event in ("socket.connect", "socket.bind") else given[0]
            raise PermissionError(f"{REFUSED[event]}: {what!r}; {EXPECTED}")

    sys.addaudithook(watch)


def _check_file(given: tuple[object, ...], legal: tuple[str, ...]) -> None:
    path, _mode, flags = given
    if isinstance(path, int) or COMPILED in str(path):
        return
    file = os.path.realpath(os.fsdecode(path))  # type: ignore[arg-type]
    if isinstance(flags, int) and flags & WRITING and not file.startswith("/dev/"):
        raise PermissionError(f"writes {file!r}; {EXPECTED}")
    if not any(Path(file).is_relative_to(folder) for folder in legal):
        raise PermissionError(f"reads {file!r}; {EXPECTED}")
