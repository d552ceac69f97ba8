"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

import os
import time

# Each core has a process of the build's own: threads of OpenBLAS beside them would wait for them.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from site_builder.book_root import ROOT as ROOT  # before anything looks for scenes: whose

STARTED_NS = time.time_ns()
"""Before any module was imported whose results are cached."""
