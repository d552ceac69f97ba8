"""Facts read from the Exif data of files, against files written by Pillow."""

import io
import struct
import time
from typing import Any

import pytest
from PIL import Image
from PIL.TiffImagePlugin import IFDRational

from simulations.engine.exif import exif_facts

WRITTEN = {
    "make": "Maker", "model": "Model 1", "lens": "50 mm F1.8", "exposure_s": 1 / 125,
    "f_number": 2.8, "iso": 400.0, "focal_mm": 50.0, "focal_35mm_mm": 75.0,
}  # fmt: skip


def file_of(kind: str, order: str = ">", focal: float = 50.0, maker: str = "Maker") -> bytes:
    exif: Any = Image.Exif()
    exif.endian = order
    exif.update({0x010F: maker, 0x0110: "Model 1"})
    exif.get_ifd(0x8769).update(
        {0x829A: IFDRational(1, 125), 0x829D: IFDRational(28, 10), 0x8827: 400,
         0x920A: IFDRational(focal), 0xA405: 75, 0xA434: "50 mm F1.8"}
    )  # fmt: skip
    buffer = io.BytesIO()
    Image.new("RGB", (32, 32), (90, 90, 90)).save(buffer, kind, exif=exif)
    return buffer.getvalue()


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
def test_facts_of_a_file_are_the_facts_written_into_it(kind: str) -> None:
    for order in "<>":
        assert exif_facts(file_of(kind, order)) == pytest.approx(WRITTEN)


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
def test_truncated_or_damaged_file_gives_fewer_facts_and_no_error(kind: str) -> None:
    whole = file_of(kind)
    for cut in range(len(whole)):
        assert exif_facts(whole[:cut]).items() <= exif_facts(whole).items()
    for at in range(0, min(len(whole), 400)):
        exif_facts(whole[:at] + b"\xff" + whole[at + 1 :])


def tiff_of(*entries: bytes, data: bytes = b"") -> bytes:
    """A TIFF file of one directory, with ``data`` behind it."""
    count = struct.pack("<H", len(entries))
    return b"II*\0\x08\0\0\0" + count + b"".join(entries) + bytes(4) + data


def entry(tag: int, kind: int, count: int, value: int) -> bytes:
    return struct.pack("<HHII", tag, kind, count, value)


def jpeg_of(tiff: bytes, before: bytes = b"") -> bytes:
    body = b"Exif\0\0" + tiff
    return b"\xff\xd8" + before + b"\xff\xe1" + struct.pack(">H", len(body) + 2) + body


ISO_400, HIGH_ISO = entry(0x8827, 3, 1, 400), entry(0x8832, 4, 1, 102_400)
ICC = b"".join(b"\xff\xe2" + struct.pack(">H", 65_402) + bytes(65_400) for _ in range(3))
BEYOND = entry(0x010F, 2, 12, 9_999_999)
"""A text whose offset lies outside the file."""
BOMB = tiff_of(*[entry(0x8769, 4, 1, 12_022)] * 1000, data=struct.pack("<H", 1000) + bytes(48_000))
ODD_FILES: dict[str, tuple[bytes, dict[str, float | str]]] = {
    "a damaged entry before a sound one": (jpeg_of(tiff_of(BEYOND, ISO_400)), {"iso": 400.0}),
    "a type that is unknown": (jpeg_of(tiff_of(entry(1, 99, 9, 9), ISO_400)), {"iso": 400.0}),
    "a sensitivity of more than two bytes": (
        jpeg_of(tiff_of(entry(0x8827, 3, 1, 65535), HIGH_ISO)),
        {"iso": 102_400.0},
    ),
    "fill bytes": (jpeg_of(tiff_of(ISO_400), b"\xff" * 9), {"iso": 400.0}),
    "a large profile": (jpeg_of(tiff_of(ISO_400), ICC), {"iso": 400.0}),
    "a directory that points to itself": (
        jpeg_of(tiff_of(entry(0x8769, 4, 1, 8), ISO_400)),
        {"iso": 400.0},
    ),
    "a thousand pointers to a thousand entries": (jpeg_of(BOMB), {}),
    "only fill bytes": (b"\xff\xd8" + b"\xff" * 1_000_000, {}),
    "segments without an end": (b"\xff\xd8" + b"\xff\xe0\0\0" * 250_000, {}),
    "chunks without contents": (b"\x89PNG\r\n\x1a\n" + bytes(1_000_000), {}),
}


@pytest.mark.parametrize(("head", "facts"), ODD_FILES.values(), ids=ODD_FILES)
def test_odd_and_hostile_headers_give_their_valid_facts_within_a_second(
    head: bytes, facts: dict[str, float | str]
) -> None:
    begun = time.process_time()
    assert exif_facts(head) == facts
    assert time.process_time() - begun < 1.0


@pytest.mark.parametrize("focal", [0.0, 1e-6, 4e9])
def test_implausible_numbers_are_left_out_and_texts_shortened(focal: float) -> None:
    facts = exif_facts(file_of("JPEG", focal=focal, maker="<A>\x01\n" + "M" * 5000))
    assert facts.keys() == WRITTEN.keys() - {"focal_mm"}
    assert facts["make"] == "<A>" + 77 * "M"
