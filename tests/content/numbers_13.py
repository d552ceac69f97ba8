"""Appendix D: measure your camera."""

from math import erfc

from support.worked_numbers import Phrases

CHAPTER = "13-measure-your-camera"


def pairs_that_differ_by_two_standard_errors() -> Phrases:
    """A difference of 2 s is √2 of its own standard errors: erfc(√2/√2)."""
    yield f"of two measurements of the same thing, {100 * erfc(1):.0f} % of pairs differ"
