"""How often the truth is within the errors that the instruments print, as shares of 200 simulated
cameras in each world of `models.test_coverage_of_errors`, for ``content/costs.json``.
``python -m bench.coverage lens`` measures one instrument only."""

import sys

from bench.costs import store_section
from models.test_coverage_of_errors import WORLDS, shares

CAMERAS, SIDE = 200, 128


def slug(name: str) -> str:
    return name.replace(" ", "-")


def main() -> None:
    for kind in sys.argv[1:] or WORLDS:
        found = {}
        for world in WORLDS[kind][1]:
            found[slug(world)] = {
                slug(number): {
                    "one_pct": round(100 * one),
                    "two_pct": round(100 * two),
                    "unreported_pct": round(100 * unreported),
                    "beyond_four_pct": round(100 * float(beyond), 1),
                }
                for number, (one, two, unreported, beyond) in shares(
                    kind, world, CAMERAS, SIDE
                ).items()
            }
            print(kind, world, found[slug(world)], flush=True)
        store_section(f"{kind}_coverage", found)


if __name__ == "__main__":
    main()
