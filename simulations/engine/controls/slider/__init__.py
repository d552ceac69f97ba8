"""A kind of control: a number in a range."""
