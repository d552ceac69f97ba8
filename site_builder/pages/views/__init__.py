"""Data of one thing for its template: a figure, a question, a list."""
