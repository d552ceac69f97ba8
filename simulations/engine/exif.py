"""What a camera wrote into a file of a photograph: Exif 2.32 (CIPA DC-008), the few tags of use.

Only the first bytes of a file are needed: in a JPEG, Exif is the segment APP1 before the picture
(section 4.7.2), in a PNG the chunk ``eXIf`` before the data. Inside is a TIFF file.
"""

import struct
from collections.abc import Iterator

PNG = b"\x89PNG\r\n\x1a\n"
POINTER = 0x8769
"""Tag of the directory of the exposure."""
TEXTS = {0x010F: "make", 0x0110: "model", 0xA434: "lens"}
LONGEST = 80
"""Characters of a text that are kept."""
NUMBERS = {
    0x829A: ("exposure_s", 1e-7, 1e5),
    0x829D: ("f_number", 0.1, 1e3),
    0x8827: ("iso", 1.0, 1e7),
    0x920A: ("focal_mm", 0.1, 1e4),
    0xA405: ("focal_35mm_mm", 1.0, 1e4),
}
"""Name, and the least and largest value that a camera can have."""
SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 7: 1, 9: 4, 10: 8}
"""Bytes of one value, by type (TIFF 6.0, section 2)."""
FORMATS = {3: "H", 4: "I", 5: "II", 9: "i", 10: "ii"}
MOST_ENTRIES = 1000


def exif_facts(head: bytes) -> dict[str, float | str]:
    """Facts by name, as far as ``head``, the first bytes of a file, has them.

    Names and units are those of `simulations.engine.photograph.Photograph.facts`. Damaged data give
    fewer facts, never an error, and so do numbers that no camera has.
    """
    facts: dict[str, float | str] = {}
    try:
        for tag, value in _entries(_tiff(head)):
            if tag in TEXTS and isinstance(value, bytes):
                text = _printable(value)
                facts |= {TEXTS[tag]: text} if text else {}
            elif tag in NUMBERS and isinstance(value, float):
                name, least, most = NUMBERS[tag]
                facts |= {name: value} if least <= value <= most else {}
    except (struct.error, IndexError, OverflowError):  # the last where addresses have 32 bits
        pass
    return facts


def _printable(value: bytes) -> str:
    text = value.split(b"\0")[0].decode("utf-8", "replace")
    return "".join(sign for sign in text if sign.isprintable())[:LONGEST].strip()


def _tiff(head: bytes) -> bytes:
    """The TIFF file inside; empty if there is none."""
    if head.startswith(b"\xff\xd8"):
        return _in_jpeg(head)
    return _in_png(head) if head.startswith(PNG) else b""


def _in_jpeg(head: bytes) -> bytes:
    at = 2
    while head[at] == 0xFF and head[at + 1] != 0xDA:  # the start of the scan ends the headers
        (length,) = struct.unpack_from(">H", head, at + 2)
        body = head[at + 4 : at + 2 + length]
        if head[at + 1] == 0xE1 and body.startswith(b"Exif\0\0"):
            return body[6:]
        at += 2 + length
    return b""


def _in_png(head: bytes) -> bytes:
    at = len(PNG)
    while head[at + 4 : at + 8] != b"IDAT":
        (length,) = struct.unpack_from(">I", head, at)
        if head[at + 4 : at + 8] == b"eXIf":
            return head[at + 8 : at + 8 + length]
        at += 12 + length
    return b""


def _entries(tiff: bytes) -> Iterator[tuple[int, float | bytes]]:
    """Tag and value of all entries of the first directory and of that of the exposure.

    Raises `struct.error` where the file ends too early.
    """
    if tiff[:4] not in (b"II*\0", b"MM\0*"):
        return
    order = "<" if tiff.startswith(b"II") else ">"
    (first,) = struct.unpack_from(f"{order}I", tiff, 4)
    for tag, value in _directory(tiff, first, order):
        if tag == POINTER and isinstance(value, float):
            yield from _directory(tiff, int(value), order)
        yield tag, value


def _directory(tiff: bytes, start: int, order: str) -> Iterator[tuple[int, float | bytes]]:
    (count,) = struct.unpack_from(f"{order}H", tiff, start)
    for at in range(start + 2, start + 2 + 12 * min(count, MOST_ENTRIES), 12):
        tag, kind, length = struct.unpack_from(f"{order}HHI", tiff, at)
        size = SIZES.get(kind, 0) * length
        (place,) = struct.unpack_from(f"{order}I", tiff, at + 8) if size > 4 else (at + 8,)
        if kind == 2:
            yield tag, struct.unpack_from(f"{length}s", tiff, place)[0]
        elif kind in FORMATS and length:
            parts = struct.unpack_from(order + FORMATS[kind], tiff, place)
            if len(parts) == 1:
                yield tag, float(parts[0])
            elif parts[1]:
                yield tag, parts[0] / parts[1]
