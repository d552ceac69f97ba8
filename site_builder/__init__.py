"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

import os
import sys
import time
from pathlib import Path

from site_builder.files.engine import hidden_parts

# Each core has a process of the build's own: threads of OpenBLAS beside them would wait for them.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

if sys.flags.safe_path:  # by which Python leaves out the current folder, a book's
    sys.path.insert(0, os.fspath(Path.cwd()))
if hidden := hidden_parts(Path.cwd()):  # before anything of it is imported
    raise SystemExit("\n".join(hidden))

STARTED_NS = time.time_ns()
"""Before any module was imported whose results are cached."""
