"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

from site_builder import book_root as book_root  # before anything looks for scenes: whose
