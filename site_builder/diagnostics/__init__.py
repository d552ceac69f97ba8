"""Mistakes and warnings with their places, and the lines of authors' code that raise them."""
