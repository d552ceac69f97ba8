"""Style sheets for what knows neither variables nor themes: as on paper."""

import re

TOKEN = re.compile(r"^  (--[\w-]+): light-dark\(([^,]+), [^)]+\);", re.MULTILINE)
CONTAINER = re.compile(r"^@container (?:.*\n)*?\}\n", re.MULTILINE)


def light_tokens(sheet: str) -> dict[str, str]:
    """The colours of the light theme, by the name of their variable."""
    return dict(TOKEN.findall(sheet))


def resolve(sheet: str, tokens: dict[str, str]) -> str:
    """Without variables. Raises `KeyError` for one that is not a token."""
    return re.sub(r"var\((--[\w-]+)\)", lambda found: tokens[found[1]], sheet)


def without_containers(sheet: str) -> str:
    """Without what depends on the width of a place in the page."""
    return CONTAINER.sub("", sheet)
