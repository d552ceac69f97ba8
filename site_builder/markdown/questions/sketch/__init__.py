"""A kind of question: a curve to draw."""
