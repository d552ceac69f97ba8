"""A kind of control: a button."""
