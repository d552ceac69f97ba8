"""A kind of control: one of several options."""
