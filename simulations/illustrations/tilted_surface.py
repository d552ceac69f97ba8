"""One beam on a level and on a tilted table: the same light on a larger area."""

import math

from simulations.engine.drafting import arc, dimension, label
from simulations.engine.drawing import arrow, line
from simulations.engine.illustration import Illustration, Panel
from simulations.models.light.reflectance import lambert

WIDTH, HEIGHT = 320.0, 254.0
BEAM, RAYS = 70.0, 5
MIDDLE, TABLE = 150.0, 150.0
TILTS_DEG = (0.0, 60.0)


def share(tilt_deg: float) -> float:
    """Irradiance of the tilted table, as a share of the level one's."""
    tilt = math.radians(tilt_deg)
    return float(lambert((math.sin(tilt), 0.0, math.cos(tilt)), (0.0, 0.0, 1.0)))


def _panel(tilt_deg: float) -> Panel:
    tilt = math.radians(tilt_deg)
    half = BEAM / 2 / math.cos(tilt)
    along = (math.cos(tilt), math.sin(tilt))

    def on(s: float) -> tuple[float, float]:
        """A place on the table, from the middle of the beam downhill."""
        return MIDDLE + s * along[0], TABLE + s * along[1]

    nx, ny = math.sin(tilt), -math.cos(tilt)
    ends = [(on(s)[0] - 16 * nx, on(s)[1] - 16 * ny) for s in (-half, half)]
    marks = []
    for index in range(RAYS):
        s = -half + 2 * half * index / (RAYS - 1)
        marks.append(arrow((on(s)[0], 20), on(s), "light"))
    marks += [
        line(on(-half - 14), on(half + 14), "world bold"),
        dimension((MIDDLE - BEAM / 2, 12), (MIDDLE + BEAM / 2, 12), "light"),
        dimension(ends[0], ends[1], "world"),
        label((MIDDLE + BEAM / 2 + 10, 17), "w", "light italic"),
    ]
    name = "w" if tilt_deg == 0 else "w / cos θ = 2 w"
    below, anchor = (MIDDLE - 34 * nx, TABLE - 34 * ny + 4), "end" if tilt_deg else "middle"
    marks.append(label(below, name, "world italic", anchor))
    if tilt_deg:
        tip = (MIDDLE + 84 * nx, TABLE + 84 * ny)
        marks += [
            arrow((MIDDLE, TABLE), tip, "camera bold"),
            arc((MIDDLE, TABLE), 44, math.pi / 2 - tilt, math.pi / 2, "ray"),
            label((tip[0] + 6, tip[1] + 4), "n", "camera italic"),
            label((MIDDLE + 25, TABLE - 47), "θ", "ray italic ground"),
        ]
    shared = f"light on each metre: {share(tilt_deg):.2g}"
    marks.append(label((WIDTH / 2, HEIGHT - 4), shared, "muted small", "middle"))
    title = "Straight down" if tilt_deg == 0 else f"Tilted by {tilt_deg:.0f}°"
    return Panel(f"tilt-{tilt_deg:.0f}", title, WIDTH, HEIGHT, overlay="".join(marks))


def draw() -> Illustration:
    words = (
        "A beam of width w falls straight on a level table and lights a strip of width w. On a "
        f"table tilted by {TILTS_DEG[1]:.0f}° the same beam lights a strip twice as wide, and each "
        f"metre of it gets {share(TILTS_DEG[1]):.2g} of the light."
    )
    return Illustration(tuple(_panel(tilt) for tilt in TILTS_DEG), words)
