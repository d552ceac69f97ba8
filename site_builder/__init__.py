"""From Markdown and simulations to a static site. Start reading at `site_builder.build`."""
