"""The film of the guide: a falling ball, drawn and packed when the guide is written, so that the
repository keeps no binary.

A WebM film is a tree of elements, each an id, a length and what it holds. Each frame here is a key
frame of VP8, which is what a lossy WebP picture has inside.

Reference: RFC 8794 (EBML), RFC 9559 (Matroska), RFC 9649 (WebP).
"""

import io
import struct
from collections.abc import Iterator, Sequence

from PIL import Image, ImageDraw

SIZE = 320, 240
RATE_HZ, SECONDS = 10, 2.0
GRAVITY = 9.81
METRES = 20.0
"""From the upper to the lower edge."""
PAPER, INK, BALL = (250, 247, 240), (60, 56, 50), (150, 60, 20)

HEADER, VERSION, DOCUMENT, DOCUMENT_VERSION = 0x1A45DFA3, 0x4286, 0x4282, 0x4287
SEGMENT, INFO, SCALE, DURATION, MUXER, WRITER = (
    0x18538067, 0x1549A966, 0x2AD7B1, 0x4489, 0x4D80, 0x5741,
)  # fmt: skip
TRACKS, TRACK, NUMBER, UID, KIND, CODEC, VIDEO, WIDTH, HEIGHT = (
    0x1654AE6B, 0xAE, 0xD7, 0x73C5, 0x83, 0x86, 0xE0, 0xB0, 0xBA,
)  # fmt: skip
CLUSTER, TIME, BLOCK = 0x1F43B675, 0xE7, 0xA3
MS_IN_NS = 1_000_000
KEY_FRAME = 0x80


def falling_ball() -> list[Image.Image]:
    """The frames, the ball at the top in the first."""
    return [_frame(n / RATE_HZ) for n in range(round(SECONDS * RATE_HZ) + 1)]


def still(frame: Image.Image) -> bytes:
    """A frame as PNG."""
    data = io.BytesIO()
    frame.save(data, "PNG")
    return data.getvalue()


def webm(frames: Sequence[Image.Image], rate_hz: float) -> bytes:
    """A film of RGB pictures, all of one size."""
    width, height = frames[0].size
    last_ms = len(frames) * 1000.0 / rate_hz
    info = (
        _number(SCALE, MS_IN_NS),
        _element(DURATION, struct.pack(">d", last_ms)),
        *(_element(name, b"guide for authors") for name in (MUXER, WRITER)),
    )
    picture = _element(VIDEO, _number(WIDTH, width), _number(HEIGHT, height))
    track = (_number(NUMBER, 1), _number(UID, 1), _number(KIND, 1), _element(CODEC, b"V_VP8"))
    return _element(
        HEADER, _number(VERSION, 1), _element(DOCUMENT, b"webm"), _number(DOCUMENT_VERSION, 2)
    ) + _element(
        SEGMENT,
        _element(INFO, *info),
        _element(TRACKS, _element(TRACK, *track, picture)),
        _element(CLUSTER, _number(TIME, 0), *_blocks(frames, rate_hz)),
    )


def _frame(seconds: float) -> Image.Image:
    width, height = SIZE
    image = Image.new("RGB", SIZE, PAPER)
    pen = ImageDraw.Draw(image)
    for metre in range(0, round(METRES) + 1, 5):
        y = height * metre / METRES
        pen.line([(0, y), (width / 8, y)], INK, 2)
    x, y, radius = width / 2, height * GRAVITY * seconds**2 / 2 / METRES, 9
    pen.ellipse([x - radius, y - radius, x + radius, y + radius], BALL)
    return image


def _blocks(frames: Sequence[Image.Image], rate_hz: float) -> Iterator[bytes]:
    for n, frame in enumerate(frames):
        head = struct.pack(">BhB", 0x81, round(n * 1000 / rate_hz), KEY_FRAME)  # of track 1
        yield _element(BLOCK, head, _key_frame(frame))


def _key_frame(frame: Image.Image) -> bytes:
    data = io.BytesIO()
    frame.save(data, "WEBP", lossless=False, quality=80)
    packed = data.getvalue()
    kind, size = struct.unpack("<4sI", packed[12:20])
    if kind != b"VP8 ":
        raise ValueError(f"WebP picture with a chunk {kind!r}; legal: b'VP8 ', without an alpha")
    return packed[20 : 20 + size]


def _number(name: int, value: int) -> bytes:
    return _element(name, value.to_bytes(max(1, (value.bit_length() + 7) // 8), "big"))


def _element(name: int, *parts: bytes) -> bytes:
    """Its id carries its own length; that of what it holds is written with eight bytes."""
    inside = b"".join(parts)
    known = name.to_bytes((name.bit_length() + 7) // 8, "big")
    return known + (len(inside) | 1 << 56).to_bytes(8, "big") + inside
