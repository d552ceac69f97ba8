"""Markup that any reader of e-books knows: no elements of our own, and a panel is one drawing."""

from xml.etree.ElementTree import Element

from site_builder.editions.tree import classes, elements

PLAIN = {
    "simulation-figure": "div",
    "ladder-bench": "div",
    "form": "div",
    "fieldset": "div",
    "output": "span",
}

UNITS_PER_EM = 16
"""So that labels of illustrations are as large as on the site."""


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
        image = Element(
            "image",
            {
                "href": picture.get("src", ""),
                "width": width,
                "height": height,
                "preserveAspectRatio": "none",
            },
        )
        if "pixelated" in classes(picture):
            image.set("style", "image-rendering: pixelated")
        drawing.insert(0, image)
        view.remove(picture)
    view.attrib.pop("style", None)
