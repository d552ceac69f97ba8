"""The chart of a measured ladder."""
