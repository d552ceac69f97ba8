"""``python -m site_builder bench``: every ladder measured in CPython and in Chromium."""
