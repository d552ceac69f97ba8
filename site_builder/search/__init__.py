"""The book's search: what of its pages can be found, and the index that is made of it."""
