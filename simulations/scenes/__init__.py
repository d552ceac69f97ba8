"""One widget per file: its controls and a pure render function."""
