"""Read the author's files into a book."""
