"""A kind of question: a figure to set."""
