"""Chapters as Jupyter notebooks: words as Markdown, figures as cells that run the book's Python.

A function for each directive makes cells of the document: ``directive_cells.py`` lists them.
"""
