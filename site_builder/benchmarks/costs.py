"""What pages cost: times, bytes and memory, from ``content/costs.json``.

``make bench`` writes it: objects within objects, down to numbers whose names end in their unit,
``start.cold.book_ms``. What is said of the machine stands under ``machine``.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from site_builder.diagnostics.diagnostic import unknown

DATA = Path("content") / "costs.json"
UNITS = {"ms": "ms", "kb": "KB", "mb": "MB", "s": "s"}
"""What a name may end in, and the unit as the book writes it. 1 KB is 1000 bytes."""


class CostError(ValueError):
    """There is no such measurement; the message lists the legal names."""


@dataclass(frozen=True, slots=True)
class Cost:
    """One number."""

    value: float
    unit: str
    """Nothing of a ratio or a count."""


@dataclass(frozen=True, slots=True)
class Costs:
    """All that was measured."""

    known: Mapping[str, Any] = field(default_factory=dict)

    def find(self, path: str) -> Cost | str:
        """The value at ``path``, names with spaces between them. Raises `CostError`."""
        at: Any = self.known
        for name in path.split():
            if not isinstance(at, dict) or name not in at:
                expected = tuple(at) if isinstance(at, dict) else ()
                raise CostError(unknown("cost", name, expected))
            at = at[name]
        if isinstance(at, dict):
            raise CostError(f"{path!r} is no single cost; go on with one of {', '.join(at)}")
        if isinstance(at, str):
            return at
        return Cost(float(at), UNITS.get(path.split()[-1].rpartition("_")[2], ""))


def read_costs(root: Path) -> Costs:
    """Raises `CostError` where nothing was measured."""
    try:
        return Costs(json.loads((root / DATA).read_text(encoding="utf-8")))
    except (OSError, ValueError):
        raise CostError(f"{DATA} cannot be read; run `make bench`") from None
