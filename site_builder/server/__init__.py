"""``serve``: the book shown while it is written."""
