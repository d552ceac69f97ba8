"""The book as an EPUB 3: a folder of XHTML in a zip, readable without a script."""

import os
import re
from base64 import b64decode
from collections.abc import Mapping
from copy import deepcopy
from datetime import UTC, datetime
from pathlib import Path
from urllib.parse import quote, unquote
from uuid import NAMESPACE_URL, uuid5
from xml.etree.ElementTree import Element

from site_builder.document.book import Colours
from site_builder.editions.compose import BoundSection, Composed
from site_builder.editions.tree import (
    LinkTarget,
    bind_links,
    classes,
    elements,
    first,
    is_external,
    parse,
    xhtml,
)
from site_builder.figures.frames import as_png
from site_builder.files.folders import archive_of
from site_builder.output.fonts import face_rules
from site_builder.output.style_sheets import style_of_drawings
from site_builder.output.writer import content_bytes
from site_builder.pages.environment import render_template

MEDIA = {
    ".xhtml": "application/xhtml+xml",
    ".ncx": "application/x-dtbncx+xml",
    ".css": "text/css",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".webp": "image/webp",
    ".svg": "image/svg+xml",
    ".woff2": "font/woff2",
}
"""Every kind of file in the book, by the end of its name."""
ADDRESS = "%/:?#[]@!$&'()*+,;=~"
"""What may stand in an address, besides letters, digits and hyphens."""
FOLDER = "book/"
"""Folder of everything that the package lists."""
NCX = "toc.ncx"


def make_epub(composed: Composed, root: Path) -> bytes:
    """``root`` is the project, with the style sheets."""
    trees = {f"{section.id}.xhtml": _part(section, composed) for section in composed.sections}
    for name in ("title", "nav"):
        page = render_template(f"editions/epub-{name}.html", composed.book, composed=composed)
        trees[f"{name}.xhtml"] = parse(page)
    images = _take_images(trees, composed)
    book, identifier = composed.book, f"urn:uuid:{uuid5(NAMESPACE_URL, composed.book.title)}"
    ncx = render_template(
        "editions/epub-ncx.xml", book, identifier=identifier, sections=composed.sections
    )
    files: dict[str, bytes] = {
        **{name: xhtml(tree) for name, tree in trees.items()},
        NCX: ncx.encode(),
        "style/book.css": book_style(root, book.colours).encode(),
        **{
            f"fonts/{Path(name).name}": content_bytes(content)
            for name, content in composed.files.items()
            if name.startswith(f"{composed.assets}fonts/")
        },
        **images,
    }
    package = _package(composed, identifier, trees, files)
    container = render_template("editions/epub-container.xml", book, package=f"{FOLDER}book.opf")
    members = {
        "mimetype": b"application/epub+zip",  # the first file of the archive
        "META-INF/container.xml": container.encode(),
        f"{FOLDER}book.opf": package,
        **{FOLDER + name: content for name, content in files.items()},
    }
    return archive_of(members, stored=["mimetype"])


def _part(section: BoundSection, composed: Composed) -> Element:
    """One file of the book's text."""

    def address(place: LinkTarget) -> str:
        file = "" if place.page == section.id and place.id else f"{place.page}.xhtml"
        return f"{file}#{place.id}" if place.id else file

    content = deepcopy(section.article)
    bind_links(content, section.id, composed.ids, address)
    for link in elements(content, "a"):
        if is_external(href := link.get("href", "")):
            link.set("href", quote(href, safe=ADDRESS))
    frame = parse(render_template("editions/epub-part.html", composed.book, title=section.title))
    first(frame, "body").append(plain(content))
    return frame


def _take_images(trees: Mapping[str, Element], composed: Composed) -> dict[str, bytes]:
    """The pictures of the text, whose elements now have the addresses in the e-book."""
    taken: dict[str, bytes] = {}
    targets: dict[str, str] = {}
    for tree in trees.values():
        for name, element in [("src", e) for e in elements(tree, "img")] + [
            ("href", e) for e in elements(tree, "image")
        ]:
            source = unquote(element.get(name, "").removeprefix("../"))
            if source in targets:
                element.set(name, targets[source])
                continue
            key = source
            if source.startswith("data:"):  # of a drawing, which makes no other kind than PNG
                source, content = "drawing.png", b64decode(source.partition(",")[2])
            else:
                content = content_bytes(composed.files[source])
            if source.startswith(f"{composed.assets}stills/") and source.endswith(".webp"):
                source, content = source.removesuffix("webp") + "png", as_png(content)
            target = _free_name(Path(source), taken)
            taken[target] = content
            targets[key] = target
            element.set(name, target)
    return taken


def _free_name(picture: Path, taken: Mapping[str, bytes]) -> str:
    """One of its own in the e-book: pictures of two folders may share theirs."""
    name, number = re.sub(r"[^\w.-]+", "-", picture.stem), 1
    target = f"images/{name}{picture.suffix}"
    while target in taken:
        number += 1
        target = f"images/{name}-{number}{picture.suffix}"
    return target


def _package(
    composed: Composed, identifier: str, trees: Mapping[str, Element], files: Mapping[str, bytes]
) -> bytes:
    """The list of all files, and what the book is."""
    items = [
        (f"item-{place}", name, MEDIA[Path(name).suffix.lower()], _properties(name, trees))
        for place, name in enumerate(files)
    ]
    by_name = {name: id for id, name, _, _ in items}
    spine = ["title.xhtml", "nav.xhtml", *(f"{section.id}.xhtml" for section in composed.sections)]
    seconds = os.environ.get("SOURCE_DATE_EPOCH")
    try:
        now = datetime.fromtimestamp(int(seconds), UTC) if seconds else datetime.now(UTC)
    except (ValueError, OverflowError) as error:
        raise ValueError(f"SOURCE_DATE_EPOCH={seconds!r}; legal: seconds since 1970") from error
    package = render_template(
        "editions/epub-package.xml",
        composed.book,
        identifier=identifier,
        modified=now.strftime("%Y-%m-%dT%H:%M:%SZ"),
        items=items,
        spine=[by_name[name] for name in spine],
        ncx=by_name[NCX],
    )
    return package.encode()


def _properties(name: str, trees: Mapping[str, Element]) -> str:
    cover = next((image.get("src") for image in elements(trees["title.xhtml"], "img")), None)
    names = {element.tag for element in trees[name].iter()} if name in trees else set()
    found = {
        "cover-image": name == cover,
        "nav": name == "nav.xhtml",
        "mathml": "math" in names,
        "svg": "svg" in names,
    }
    return " ".join(property for property, has in found.items() if has)


OWN = Path(__file__).with_name("epub.css")
FAMILIES = {"--serif": '"Book Serif", serif', "--sans": '"Book Sans", sans-serif'}


def book_style(root: Path, colours: Colours) -> str:
    """``root`` is the book's folder, ``colours`` are its own. Variables are resolved, to the light
    theme."""
    own = OWN.read_text(encoding="utf-8")
    return face_rules() + style_of_drawings(root, own, FAMILIES, colours)


PLAIN = {
    "simulation-figure": "div",
    "ladder-bench": "div",
    "form": "div",
    "fieldset": "div",
    "output": "span",
}

UNITS_PER_EM = 16
"""Units with which labels of illustrations are as large as on the site."""


def plain(root: Element) -> Element:
    """``root``, changed."""
    for element in elements(root):
        if element.tag in PLAIN:
            element.set("class", f"{element.get('class', '')} {element.tag}".strip())
            element.tag = PLAIN[element.tag]
        if element.tag == "math":
            element.attrib.pop("aria-label", None)  # EPUB has `alttext` for it
        if "panel-view" in classes(element):
            _draw_in_one(element)
        if "drawing" in classes(element):
            _, _, width, _ = next(elements(element, "svg")).get("viewBox", "").split()
            element.set("style", f"max-width: {float(width) / UNITS_PER_EM:g}em")
        for name in ("data-count", "data-label"):
            element.attrib.pop(name, None)
    return root


def _draw_in_one(view: Element) -> None:
    """The picture goes into the drawing over it, so that they cannot part."""
    drawings, pictures = elements(view, "svg"), elements(view, "img")
    drawing, picture = next(drawings), next(pictures, None)
    if picture is not None:
        _, _, width, height = drawing.get("viewBox", "").split()
        size = {"width": width, "height": height, "preserveAspectRatio": "none"}
        image = Element("image", {"href": picture.get("src", ""), **size})
        if "pixelated" in classes(picture):
            image.set("style", "image-rendering: pixelated")
        drawing.insert(0, image)
        view.remove(picture)
    view.attrib.pop("style", None)
