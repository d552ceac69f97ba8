"""Copies of files as they are sent: a host that finds them has nothing to pack."""

import gzip
from collections.abc import Callable, Mapping
from pathlib import PurePosixPath

import brotli

from site_builder.cache.results import cached_result
from site_builder.files.folders import bytes_hash
from site_builder.output.assets import Content, content_bytes

PACKED = frozenset(
    (".png", ".jpg", ".jpeg", ".webp", ".woff2", ".mp4", ".webm", ".pdf", ".gz", ".br")
)
"""Kinds of files in which nothing is left to pack."""
MOST_SHARE = 0.95
"""The largest size of a copy, as a share of the file's."""


def gzipped(data: bytes) -> bytes:
    """With no time of its own, so that the same file is the same copy."""
    return gzip.compress(data, 9, mtime=0)


def brotlied(data: bytes) -> bytes:
    packed: bytes = brotli.compress(data, quality=11)
    return packed


PACKERS: Mapping[str, Callable[[bytes], bytes]] = {".br": brotlied, ".gz": gzipped}
"""Packers by the ending of a copy's name."""


def compressed_copies(files: Mapping[str, Content]) -> dict[str, bytes]:
    """Copies, ``NAME.br`` and ``NAME.gz``, of each file that they make smaller."""
    copies = {}
    for name, content in files.items():
        if PurePosixPath(name).suffix in PACKED:
            continue
        data = content_bytes(content)
        for ending, pack in PACKERS.items():
            packed = _pack_once(data, ending, pack)
            if len(packed) < MOST_SHARE * len(data):
                copies[name + ending] = packed
    return copies


def _pack_once(data: bytes, ending: str, pack: Callable[[bytes], bytes]) -> bytes:
    """Packing well takes long, so what is known by its hash is not packed again."""
    return cached_result("packed", (bytes_hash(data), ending), lambda: pack(data))
