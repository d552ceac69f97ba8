"""Renderers of passages for each medium: screen, paper, Markdown, plain text."""
