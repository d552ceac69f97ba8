"""A kind of control: lists of points in a picture."""
