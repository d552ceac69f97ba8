"""Checks of a book that has been read: before a page is written, or by ``check``.

A check adds mistakes and warnings with file and line to the `Diagnostics`; ``spoils`` names what
follows from a mistake and is held back. Its cases lie in ``tests/tables/markdown/``: the input with
``^^^ MESSAGE`` below the line that is reported, or, below a sound chapter, a row
``OLD => NEW ^^^ MESSAGE`` under ``-------- changes of FILE``.
"""
