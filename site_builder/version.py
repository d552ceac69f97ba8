"""The engine's version; in a wheel with the commit that it was built from, ``1.0.0+g1a2b3c4d``.

Hatchling runs this file by itself.
"""

import os
import subprocess
from pathlib import Path

__version__ = "1.0.0"
ROOT = Path(__file__).resolve().parents[1]
GIT = ("git", "describe", "--always", "--exclude=*", "--abbrev=8", "--dirty=.dirty")


def with_commit() -> str:
    """``….dirty`` where a file differs from the commit; without git, or where this is no repository
    of its own, the version alone."""
    own = {**os.environ, "GIT_CEILING_DIRECTORIES": os.fspath(ROOT.parent)}
    try:
        done = subprocess.run(GIT, cwd=ROOT, env=own, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return __version__
    return f"{__version__}+g{done.stdout.strip()}"
