"""``python -m site_builder new book|chapter|scene|model|ladder NAME``.

What is made stands in ``skeletons/`` and ``book/``: templates whose ``«names»`` are filled in.
"""
