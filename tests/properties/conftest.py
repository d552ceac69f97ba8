"""Fewer examples than usual: there are many properties, and together they must stay quick."""

from hypothesis import HealthCheck, settings

settings.register_profile(
    "properties",
    parent=settings.get_profile("repeatable"),
    max_examples=60,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("properties")
