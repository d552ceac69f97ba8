"""What the measured numbers say of a tier, in words."""

from site_builder.benchmarks.measurements import SIDES, MeasuredLadder, MeasuredTier
from site_builder.languages.words import ENGLISH, Words


def verdict(measured: MeasuredLadder, item: MeasuredTier, words: Words = ENGLISH) -> str:
    """What the numbers say of a tier, in a few words."""
    native, browser = (measured.beaten_by(item, side) for side in SIDES)
    if native and browser:
        both = native.tier.id == browser.tier.id
        key = "verdict.beaten" if both else "verdict.beaten_twice"
        return words(key, tier=native.tier.label, other=browser.tier.label)
    if native:
        return words("verdict.beaten_native", tier=native.tier.label)
    if browser:
        return words("verdict.beaten_browser", tier=browser.tier.label)
    match [side for side in SIDES if item in measured.front(side)]:
        case [_, _]:
            return words("verdict.front")
        case ["native"]:
            return words("verdict.front_native")
        case ["browser"]:
            return words("verdict.front_browser")
        case _:
            return words("verdict.close")
