"""What a host must answer to a `Range`, of a file that says ``0123456789``."""

WHOLE = b"0123456789"
ANSWERS = {
    "bytes=2-4": (206, b"234", "bytes 2-4/10"),
    "bytes=0-": (206, WHOLE, "bytes 0-9/10"),
    "bytes=7-": (206, b"789", "bytes 7-9/10"),
    "bytes=-3": (206, b"789", "bytes 7-9/10"),
    "bytes=-30": (206, WHOLE, "bytes 0-9/10"),
    "bytes=8-99": (206, b"89", "bytes 8-9/10"),
    "bytes=10-": (416, b"", "bytes */10"),
    "bytes=99-100": (416, b"", "bytes */10"),
    "bytes=-0": (416, b"", "bytes */10"),
    "bytes=4-2": (200, WHOLE, None),
    "bytes=0-1,4-5": (200, WHOLE, None),
    "bytes=-": (200, WHOLE, None),
    "lines=1-2": (200, WHOLE, None),
}
"""Status, body and ``Content-Range``. Source: RFC 9110, section 14."""
