"""A pendulum."""
