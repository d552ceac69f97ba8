"""Fewer Hypothesis examples than usual, since there are many properties."""

from hypothesis import HealthCheck, settings

settings.register_profile(
    "properties",
    parent=settings.get_profile("repeatable"),
    max_examples=25,
    suppress_health_check=[HealthCheck.too_slow],
)
if settings.get_current_profile_name() == "repeatable":  # and not the deep one
    settings.load_profile("properties")
