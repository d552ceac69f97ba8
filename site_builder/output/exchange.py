"""Two folders change places in one step, where the system can do that."""

import ctypes
import os
import sys
from pathlib import Path

HERE = -100 if sys.platform == "linux" else -2
"""``AT_FDCWD``."""
EXCHANGE = 2
"""``RENAME_EXCHANGE`` of Linux, ``RENAME_SWAP`` of macOS."""


def exchange(one: Path, other: Path) -> bool:
    """Whether they have changed places: at no moment is one of them missing."""
    name = {"linux": "renameat2", "darwin": "renameatx_np"}.get(sys.platform, "")
    rename = getattr(ctypes.CDLL(None), name, None) if name else None
    if rename is None:
        return False
    first, second = os.fsencode(one), os.fsencode(other)
    return bool(rename(HERE, first, HERE, second, ctypes.c_uint(EXCHANGE)) == 0)
