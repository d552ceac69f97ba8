"""Files that are no pages, and the writing of all."""
