"""What the service worker stores: the files of a release, and the manifest of the app."""

import json
from collections.abc import Mapping

from site_builder.files.folders import integrity
from site_builder.output.assets import Content, content_bytes
from site_builder.pages.embeds import FOLDER as EMBED_FOLDER
from site_builder.raw.decoder import FOLDER

MANIFEST = "manifest.webmanifest"


def manifest(title: str, subtitle: str, assets: str, language: str = "en") -> bytes:
    """The manifest, all addresses relative to the book's root."""
    icon = {"src": f"{assets}images/favicon.svg", "sizes": "any", "type": "image/svg+xml"}
    data = {
        "lang": language,
        "name": title,
        "short_name": title,
        "description": subtitle,
        "start_url": "./",
        "scope": "./",
        "display": "minimal-ui",
        "icons": [icon],
    }
    return json.dumps(data, ensure_ascii=False, indent=1).encode()


LIST = "offline.json"
WORKER = "sw.js"
SCRIPT = "js/offline/service_worker.js"
"""Path of the worker, among the assets."""
LEFT_OUT = (FOLDER,)
"""Folders of the assets that few readers need. These come from the network when they are."""


def release_files(files: Mapping[str, Content], assets: str) -> dict[str, bytes]:
    """The list of ``files`` by address and hash, and a worker that caches them.

    Each hash is written as the ``integrity`` of a request (W3C Subresource Integrity), so that the
    browser itself refuses a file of another release. A page is listed by the address that links
    lead to, as some hosts send readers on from ``index.html``. Pages for frames in other pages are
    left out: those need the network anyway.
    """
    left_out = (EMBED_FOLDER, *(assets + folder for folder in LEFT_OUT))
    stored = sorted(name for name in files if not name.startswith(left_out))
    hashes = {address(name): integrity(content_bytes(files[name])) for name in stored}
    listed = json.dumps(hashes, indent=0).encode()
    return {LIST: listed, WORKER: worker(assets, integrity(listed))}


def no_release(assets: str) -> dict[str, bytes]:
    """A worker that deletes what an earlier one has cached."""
    return {WORKER: worker(assets, "")}


def worker(assets: str, release: str) -> bytes:
    name, script = json.dumps(release), json.dumps(assets + SCRIPT)
    return f"self.RELEASE = {name};\nimportScripts({script});\n".encode()


def address(name: str) -> str:
    """
    >>> address("lens-distortion/index.html")
    'lens-distortion/'
    """
    return name.removesuffix("index.html") if name.split("/")[-1] == "index.html" else name
