"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""

from site_builder.book_root import ROOT as ROOT  # before anything looks for scenes: whose
