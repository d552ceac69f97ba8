"""Files that pages load, in folders named by a hash of what is in them: cacheable for ever."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

from site_builder.files.folders import bytes_hash, file_hash

type Content = bytes | Path
"""The bytes of a file, or its path."""


def hashed_folder(kind: str, files: Mapping[str, Content]) -> tuple[str, dict[str, Content]]:
    """The folder ``KIND/HASH/`` and the files under it.

    One folder for all, not one hash per file: ES modules and style sheets keep referring to each
    other by relative addresses.
    """
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(name.encode() + b"\0" + content_hash(files[name]))
    folder = f"{kind}/{digest.hexdigest()[:12]}/"
    return folder, {folder + name: content for name, content in files.items()}


def content_hash(content: Content) -> bytes:
    if isinstance(content, bytes):
        return bytes_hash(content)
    return file_hash(content) or bytes_hash(content.read_bytes())


def content_bytes(content: Content) -> bytes:
    return content if isinstance(content, bytes) else content.read_bytes()
