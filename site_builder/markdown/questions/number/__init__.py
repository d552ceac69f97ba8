"""A kind of question: a number."""
