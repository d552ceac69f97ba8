"""Pictures inside drawings, as files beside the page: it is painted without waiting for them."""

import io
import re
from base64 import b64decode

import numpy as np

from site_builder.cache.results import cached
from site_builder.figures.frames import webp
from site_builder.files.folders import bytes_hash

INSIDE = re.compile(r'(?<= href=")data:image/png;base64,([^"]+)')


def pictures_in(drawing: str) -> dict[str, bytes]:
    """The pictures of SVG by the names of their files."""
    return {_name(data): _packed(data) for data in INSIDE.findall(drawing)}


def with_files(drawing: str, folder: str) -> str:
    """SVG whose pictures are the files in a ``folder``, which ends in a slash."""
    return INSIDE.sub(lambda found: folder + _name(found[1]), drawing)


def _name(data: str) -> str:
    return f"drawing-{bytes_hash(data.encode()).hex()[:16]}.webp"


@cached
def _packed(data: str) -> bytes:
    from PIL import Image  # only where something is not cached

    return webp(np.asarray(Image.open(io.BytesIO(b64decode(data)))))
