"""What templates are given of one thing: a figure, a question, a list."""
