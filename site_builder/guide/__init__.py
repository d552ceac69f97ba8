"""The guide for authors: a book that this builder builds, half of it out of its declarations."""
