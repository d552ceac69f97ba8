"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

import time

STARTED_NS = time.time_ns()
"""Before any other module of ours was imported."""
