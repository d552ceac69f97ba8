"""One speed/accuracy ladder per file."""
