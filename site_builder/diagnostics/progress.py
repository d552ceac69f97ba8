"""A line on the standard error for each step of the first build that takes seconds."""

import sys

END = "…"


def announce(step: str) -> None:
    """Print ``step`` as it begins: ``fetching Pyodide…``."""
    print(f"{step}{END}", file=sys.stderr, flush=True)
