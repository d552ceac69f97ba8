"""What the measured numbers say of a tier, in words."""

from site_builder.measured.measurements import SIDES, MeasuredLadder, MeasuredTier


def verdict(measured: MeasuredLadder, item: MeasuredTier) -> str:
    """What the numbers say of a tier, in a few words."""
    native, browser = (measured.beaten_by(item, side) for side in SIDES)
    if native and browser:
        both = native.tier.id == browser.tier.id
        text = f"beaten by {native.tier.label}"
        return text if both else f"{text}; in the browser by {browser.tier.label}"
    if native:
        return f"beaten by {native.tier.label} in CPython only"
    if browser:
        return f"beaten by {browser.tier.label} in the browser only"
    match [side for side in SIDES if item in measured.front(side)]:
        case [_, _]:
            return "on the front"
        case ["native"]:
            return "on the front in CPython only"
        case ["browser"]:
            return "on the front in the browser only"
        case _:
            return "close behind the front"
