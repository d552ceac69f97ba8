"""The files of a folder, and the hash of a file, read again only where it has changed."""

import base64
import functools
import hashlib
import io
import os
import re
import stat
import tempfile
import zipfile
from collections.abc import Collection, Mapping
from fnmatch import fnmatch
from pathlib import Path
from urllib.parse import quote

from platformdirs import user_cache_path

SIZE = 20
_known: dict[str, tuple[tuple[int, int, int], bytes]] = {}


@functools.cache
def cache_folder() -> Path:
    """What this user's builds keep; in the system's temporary folder where the user's own cannot be
    made."""
    folder = user_cache_path("image-formation", appauthor=False)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        from site_builder.diagnostics.diagnostic import announce  # needs the engine

        announce(f"{error}; XDG_CACHE_HOME names another folder; taking a temporary one")
        user = getattr(os, "getuid", int)()
        folder = Path(tempfile.gettempdir(), f"image-formation-{user}")
        folder.mkdir(mode=0o700, exist_ok=True)
        if user and folder.stat().st_uid != user:
            folder = Path(tempfile.mkdtemp(prefix="image-formation-"))
    return folder


def bytes_hash(data: bytes) -> bytes:
    return hashlib.blake2b(data, digest_size=SIZE).digest()


def integrity(data: bytes) -> str:
    """Hash in the form of W3C Subresource Integrity."""
    return "sha256-" + base64.b64encode(hashlib.sha256(data).digest()).decode()


def file_hash(file: Path | str) -> bytes | None:
    """The hash of its bytes; None where there is no such file."""
    name = os.fspath(file)
    try:
        found = os.stat(name)  # noqa: PTH116  (asked of every file in every build)
        if not stat.S_ISREG(found.st_mode):  # of a pipe or a device there is no end
            return None
        state = (found.st_mtime_ns, found.st_size, found.st_ino)
        known = _known.get(name)
        if known and known[0] == state:
            return known[1]
        digest = bytes_hash(Path(name).read_bytes())
    except OSError:
        return None
    _known[name] = (state, digest)
    return digest


def folder_hash(folder: Path, pattern: str = "*") -> bytes:
    """The hash of the names and bytes of all matching files below it, without compiled code."""
    digest = hashlib.blake2b(digest_size=SIZE)
    for name, file in folder_files(folder).items():
        if fnmatch(name, pattern) and (found := file_hash(file)):
            digest.update(len(name).to_bytes(4, "little") + name.encode() + found)
    return digest.digest()


def is_side_file(name: str) -> bool:
    """Whether an editor or a system keeps it beside a file: ``.#a.py``, ``._a.md``, ``a.py~``."""
    return name.startswith((".", "#")) or name.endswith("~")


def folder_files(folder: Path) -> dict[str, Path]:
    """All files below ``folder``, by their path in it, without what is compiled or hidden and the
    side files of editors."""
    names, start = [], len(os.fspath(folder)) + 1
    for place, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith((".", "__pycache__"))]
        paths = (f"{place}/{name}" for name in files if not is_side_file(name))
        names += [path[start:] for path in paths if os.path.isfile(path)]  # noqa: PTH113  (fast)
    return {name: folder / name for name in sorted(names)}


NAMED = re.compile(r"""["']((?:[\w-]+/)*[\w-][\w.-]*\.\w+)["']""")


def data_of(module: Path) -> dict[str, Path]:
    """What travels with a module to readers: files beside it, or in folders there, which a text in
    it names; by that path."""
    names = NAMED.findall(module.read_text(encoding="utf-8", errors="replace"))
    files = {name: module.parent / name for name in names if not name.endswith(".py")}
    return {name: file for name, file in sorted(files.items()) if is_file(file)}


def is_file(path: Path) -> bool:
    """Whether there is such a file; there is none of a name that is too long."""
    return os.path.isfile(path)  # noqa: PTH113


def address_of(path: str) -> str:
    """A path as it stands in an address, each of its names encoded.

    >>> address_of("content/Fig #3, 50%.png")
    'content/Fig%20%233%2C%2050%25.png'
    """
    return quote(path)


def archive_of(members: Mapping[str, bytes], stored: Collection[str] = ()) -> bytes:
    """Compressed but for those named in ``stored``, in their order and without times: equal members
    give equal bytes."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for path, content in members.items():
            how = zipfile.ZIP_STORED if path in stored else zipfile.ZIP_DEFLATED
            archive.writestr(zipfile.ZipInfo(path), content, how)
    return buffer.getvalue()


def replace_files(files: Mapping[Path, bytes]) -> None:
    """Write files whole, each beside its place before the first is moved there: a reader has the
    old one or the new one, and where the disk is full all stay as they were.

    A link stays a link, and a file that is replaced keeps its permissions. Raises `OSError`.
    """
    written: dict[Path, str] = {}
    try:
        for file in files:
            place = file.resolve()
            place.parent.mkdir(parents=True, exist_ok=True)
            handle, written[place] = tempfile.mkstemp(dir=place.parent, prefix=".new-")
            with os.fdopen(handle, "wb") as stream:
                stream.write(files[file])
            mode = place.stat().st_mode if place.exists() else 0o644
            Path(written[place]).chmod(stat.S_IMODE(mode))
        for place, name in written.items():
            Path(name).replace(place)
    finally:
        for name in written.values():
            Path(name).unlink(missing_ok=True)


def replace_file(file: Path, data: bytes) -> None:
    replace_files({file: data})
