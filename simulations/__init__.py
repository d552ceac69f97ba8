"""Image formation, simulated: the same Python in the book's build and in the reader's browser."""
