"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

import time

from site_builder.book_root import ROOT as ROOT  # before anything looks for scenes: whose

STARTED_NS = time.time_ns()
"""Before any module of ours was imported that computes."""
