"""What opens a figure's Python: the code editor, bundled, and the sources of every scene."""
