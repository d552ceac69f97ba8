"""Markdown to the page model: the parser, and one file per construct."""
