"""Parts of a file, as a film that is wound forward or a download that is taken up again asks for
them. Source: RFC 9110, section 14."""

import re

ASKED = re.compile(r"bytes=(\d*)-(\d*)")


def asked_part(header: str, size: int) -> range | None:
    """The bytes that a ``Range`` asks for, of a file of so many.

    Empty where the file has none of them; nothing where the header means nothing, or several parts
    at once: then a host may send the whole.

    >>> asked_part("bytes=2-", 5), asked_part("bytes=-2", 5), asked_part("bytes=0-99", 5)
    (range(2, 5), range(3, 5), range(0, 5))
    """
    asked = ASKED.fullmatch(header.strip())
    if not asked or not any(asked.groups()):
        return None
    first, last = asked.groups()
    if not first:
        return range(max(size - int(last), 0), size)
    if last and int(last) < int(first):
        return None
    return range(int(first), min(int(last) + 1, size) if last else size)
