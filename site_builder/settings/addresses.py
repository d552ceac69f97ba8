"""Where the site will be, and where its sources are: what ``book.toml`` or the command line says.

Without them nothing absolute is written, and the site is at home at any address.
"""

from urllib.parse import urlsplit

PATH = "{path}"


def site_address(given: object) -> str:
    """As pages begin with it, a slash at the end. Raises `ValueError`."""
    if given == "":
        return ""
    legal = "legal: 'https://host/' or 'https://host/path/'"
    if not isinstance(given, str) or not _is_plain(given):
        raise ValueError(f"address {given!r}; {legal}")
    parts = urlsplit(given)
    if parts.scheme not in ("https", "http") or not parts.hostname or parts.query or parts.fragment:
        raise ValueError(f"address {given!r}; {legal}")
    return given if given.endswith("/") else f"{given}/"


def source_address(given: object) -> str:
    """With ``{path}`` in the place of a file's path. Raises `ValueError`."""
    if given == "":
        return ""
    if (
        not isinstance(given, str)
        or given.count(PATH) != 1
        or not _is_plain(given)
        or not given.startswith(("https://", "http://"))
    ):
        raise ValueError(f"source {given!r}; legal: 'https://host/…/{PATH}', with {PATH} once")
    return given


def _is_plain(given: str) -> bool:
    return given.isprintable() and not any(character in given for character in " \"'<>\\")
