"""What a camera wrote into a file of a photograph: Exif 2.32 (CIPA DC-008), the few tags of use.

Only the first bytes of a file are needed: in a JPEG, Exif is the segment APP1 before the picture
(section 4.7.2), in a PNG the chunk ``eXIf`` before the data. Inside is a TIFF file.
"""

import re
import struct
from collections.abc import Iterator

PNG = b"\x89PNG\r\n\x1a\n"
POINTER = 0x8769
"""Tag of the directory of the exposure."""
TEXTS = {0x010F: "make", 0x0110: "model", 0xA434: "lens"}
LONGEST = 80
"""Characters of a text that are kept."""
NUMBERS = {
    0x0112: ("orientation", 1.0, 8.0),
    0x829A: ("exposure_s", 1e-7, 1e5),
    0x829D: ("f_number", 0.1, 1e3),
    0x8827: ("iso", 1.0, 65534.0),  # two bytes: 65535 means a larger value
    0x8832: ("iso", 1.0, 1e7),
    0x920A: ("focal_mm", 0.1, 1e4),
    0xA405: ("focal_35mm_mm", 1.0, 1e4),
}
"""Name, and the least and largest value that a camera can have."""
SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 7: 1, 9: 4, 10: 8}
"""Bytes of one value, by type (TIFF 6.0, section 2)."""
FORMATS = {3: "H", 4: "I", 5: "II", 9: "i", 10: "ii"}
MOST_ENTRIES = 250
"""Entries that are read of each of the two directories."""
MARKER = re.compile(rb"\xff+([^\xff])")
"""A marker of a JPEG, which any number of fill bytes may precede."""


def exif_facts(head: bytes) -> dict[str, float | str]:
    """Facts by name, as far as ``head``, the first bytes of a file, has them.

    Names and units: see `simulations.engine.photograph.Photograph.facts`. Damaged data, and numbers
    that no camera has, give fewer facts, never an error.
    """
    facts: dict[str, float | str] = {}
    for tag, value in _entries(_tiff(head)):
        if tag in TEXTS and isinstance(value, bytes) and (text := _printable(value)):
            facts.setdefault(TEXTS[tag], text)
        elif tag in NUMBERS and isinstance(value, float):
            name, least, most = NUMBERS[tag]
            if least <= value <= most:
                facts.setdefault(name, value)
    return facts


def _printable(value: bytes) -> str:
    text = value[: 4 * LONGEST].split(b"\0")[0].decode("utf-8", "replace")
    return "".join(sign for sign in text if sign.isprintable())[:LONGEST].strip()


def _tiff(head: bytes) -> bytes:
    """The TIFF file inside; empty if there is none."""
    if head.startswith(b"\xff\xd8"):
        return _in_jpeg(head)
    return _in_png(head) if head.startswith(PNG) else b""


def _in_jpeg(head: bytes) -> bytes:
    at = 2
    while (found := MARKER.match(head, at)) and found[1] != b"\xda":  # where the scan begins
        at = found.end()
        length = int.from_bytes(head[at : at + 2])
        body = head[at + 2 : at + length]
        if found[1] == b"\xe1" and body.startswith(b"Exif\0\0"):
            return body[6:]
        at += max(length, 2)
    return b""


def _in_png(head: bytes) -> bytes:
    at = len(PNG)
    while at < len(head) and head[at + 4 : at + 8] != b"IDAT":
        length = int.from_bytes(head[at : at + 4])
        if head[at + 4 : at + 8] == b"eXIf":
            return head[at + 8 : at + 8 + length]
        at += 12 + length
    return b""


def _entries(tiff: bytes) -> Iterator[tuple[int, float | bytes]]:
    """Tag and value of the entries of the first directory, then of the exposure's directory."""
    if tiff[:4] not in (b"II*\0", b"MM\0*"):
        return
    order = "<" if tiff.startswith(b"II") else ">"
    first = [*_directory(tiff, _number(tiff, 4, order), order)]
    yield from first
    pointers = (value for tag, value in first if tag == POINTER and isinstance(value, float))
    if pointer := next(pointers, 0.0):
        yield from _directory(tiff, int(pointer), order)


def _number(tiff: bytes, at: int, order: str, size: int = 4) -> int:
    """A whole number; 0 where the file has ended."""
    return int.from_bytes(tiff[at : at + size], "little" if order == "<" else "big")


def _directory(tiff: bytes, start: int, order: str) -> Iterator[tuple[int, float | bytes]]:
    """Tag and value of each entry that is whole."""
    count = min(_number(tiff, start, order, 2), MOST_ENTRIES)
    for at in range(start + 2, min(start + 2 + 12 * count, len(tiff) - 11), 12):
        tag, kind, length, place = struct.unpack_from(f"{order}HHII", tiff, at)
        size = SIZES.get(kind, 0) * length
        value = tiff[place : place + size] if size > 4 else tiff[at + 8 : at + 8 + size]
        if len(value) < size:
            continue
        if kind == 2:
            yield tag, value
        elif kind in FORMATS and length:
            parts = struct.unpack_from(order + FORMATS[kind], value)
            if len(parts) == 1:
                yield tag, float(parts[0])
            elif parts[1]:
                yield tag, parts[0] / parts[1]
