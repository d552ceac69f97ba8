"""A kind of question: a function to write."""
