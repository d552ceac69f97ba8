"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

import time

import site_builder.book_root  # noqa: F401  (before anything looks for scenes: whose)

STARTED_NS = time.time_ns()
"""Before any module of ours was imported that computes."""
