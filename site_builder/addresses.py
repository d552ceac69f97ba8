"""Where the site will be, and where its sources are, as the command line says it."""

from site_builder.settings.kinds import ADDRESS, SOURCE, Text

PATH = "{path}"


def site_address(given: str) -> str:
    """With the slash at its end, given or not. Raises `ValueError`."""
    return _read("address", ADDRESS, f"{given.removesuffix('/')}/") if given else ""


def source_address(given: str) -> str:
    """With ``{path}`` in the place of a file's path. Raises `ValueError`."""
    return _read("source", SOURCE, given) if given else ""


def _read(name: str, kind: Text, given: str) -> str:
    try:
        return kind.read(given)
    except ValueError as error:
        raise ValueError(f"{name} {given!r}; legal: {kind.legal}") from error
