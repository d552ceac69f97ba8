"""Files for the host and for the service worker: media types, caching, the content security policy,
compressed copies, listings, and the list of a release."""

import gzip
import json
import re
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from pathlib import PurePosixPath
from urllib.parse import urlsplit

import brotli

from site_builder.cache.results import cached_result
from site_builder.document.book import Book
from site_builder.files.folders import address_of, bytes_hash, integrity
from site_builder.output.writer import Content, content_bytes
from site_builder.pages.embeds import EMBED_FOLDER
from site_builder.pages.environment import render_template
from site_builder.pages.single_page import page_address
from site_builder.raw.decoder import FOLDER

PACKED = frozenset((".png", ".jpg", ".jpeg", ".webp", ".woff2", ".gz", ".br"))
"""Kinds of files in which nothing is left to pack."""
MOST_SHARE = 0.95
"""The largest size of a copy, as a share of the file's."""


PACKERS: Mapping[str, Callable[[bytes], bytes]] = {
    ".br": partial(brotli.compress, quality=11),
    ".gz": partial(gzip.compress, compresslevel=9, mtime=0),
}
"""Packers by the ending of a copy's name: the same file is the same copy, without a time."""


def compressed_copies(files: Mapping[str, Content]) -> dict[str, bytes]:
    """Copies, ``NAME.br`` and ``NAME.gz``, of each file that they make smaller."""
    copies = {}
    for name, content in files.items():
        if PurePosixPath(name).suffix.lower() in PACKED:
            continue
        data = content_bytes(content)
        for ending, pack in PACKERS.items():
            # Packing well takes long, so what is known by its hash is not packed again.
            packed = cached_result("packed", (bytes_hash(data), ending), partial(pack, data))
            if len(packed) < MOST_SHARE * len(data):
                copies[name + ending] = packed
    return copies


MANIFEST = "manifest.webmanifest"


def manifest(title: str, subtitle: str, assets: str, language: str = "en") -> bytes:
    """The manifest, all addresses relative to the book's root."""
    icon = {"src": f"{assets}images/favicon.svg", "sizes": "any", "type": "image/svg+xml"}
    data = {
        "lang": language, "name": title, "short_name": title, "description": subtitle,
        "start_url": "./", "scope": "./", "display": "minimal-ui", "icons": [icon],
    }  # fmt: skip
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
    >>> address("lens-distortion/index.html"), address("content/Fig #3.png")
    ('lens-distortion/', 'content/Fig%20%233.png')
    """
    is_page = name.split("/")[-1] == "index.html"
    return address_of(name.removesuffix("index.html") if is_page else name)


FILES: Mapping[str, str] = {"apache": ".htaccess", "netlify": "_headers", "nginx": "nginx.conf"}
"""What each of them reads; ``_headers`` is known to others too."""
POLICY = re.compile(rb'<meta http-equiv="Content-Security-Policy" content="([^"]*)">')


def host_files(files: Mapping[str, Content], book: Book) -> dict[str, bytes]:
    """The configuration of each host that the book names."""
    given = book.settings.publishing
    pages = [page for name, page in files.items() if name.endswith(".html")]
    policy = common_policy(page for page in pages if isinstance(page, bytes))
    place = urlsplit(book.address).path or "/"
    return {
        FILES[host]: render_template(
            f"publishing/{host}.txt",
            book,
            policy=f"{policy}; {frame_rule(given.frames)}",
            place=place,
            compressed=given.compressed,
        ).encode()
        for host in given.hosts
    }


def frame_rule(sites: Iterable[str]) -> str:
    """Sites that may frame pages: the book and these. Only a header can say so."""
    return " ".join(("frame-ancestors 'self'", *sites))


def common_policy(pages: Iterable[bytes]) -> str:
    """What the policies of all pages allow together: a header is one for all, and pages hold to
    their own besides. It holds workers too, which no page's policy reaches."""
    allowed: dict[str, dict[str, None]] = {}
    for policy in sorted({found[1].decode() for page in pages if (found := POLICY.search(page))}):
        for rule in policy.split("; "):
            name, *sources = rule.split()
            allowed.setdefault(name, {}).update(dict.fromkeys(sources))
    return "; ".join(f"{name} {' '.join(sources)}" for name, sources in allowed.items())


NOT_LISTED = ("404.html", EMBED_FOLDER)
"""Beginnings of the paths of pages that are not to be found by themselves."""


def make_listings(book: Book, pages: Iterable[str]) -> dict[str, bytes]:
    """Files by path; nothing where the book has no address. ``pages`` are paths of the site."""
    if not book.address:
        return {}
    listed = [page_address(path) for path in pages if not path.startswith(NOT_LISTED)]
    made = {"sitemap.xml": render_template("publishing/sitemap.xml", book, pages=listed)}
    if book.news:
        made["feed.xml"] = render_template("publishing/feed.xml", book)
    if urlsplit(book.address).path == "/":  # elsewhere on a host it is not looked for
        made["robots.txt"] = render_template("publishing/robots.txt", book)
    return {path: text.encode() for path, text in made.items()}
