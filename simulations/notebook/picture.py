"""A frame as one SVG: its panels side by side, the pixels below the drawings."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from html import escape

from simulations.engine.frame import Panel
from simulations.engine.raster import png

GAP = 16.0
"""Between panels, and around them, in units of their view boxes."""
TITLE = 24.0
"""Height of the line of titles."""


def frame_svg(panels: Sequence[Panel], style: str) -> str:
    """The drawing; ``style`` is the sheet for it. A panel that leads comes first."""
    head = TITLE if any(panel.title for panel in panels) else 0.0
    width = GAP + sum(panel.width + GAP for panel in panels)
    height = head + max(panel.height for panel in panels) + 2 * GAP
    parts = "".join(_placed(sorted(panels, key=lambda panel: not panel.lead), GAP + head))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
        f'width="{width:g}" height="{height:g}"><style>{style}</style>'
        f'<rect class="sheet" width="{width:g}" height="{height:g}"/>{parts}</svg>'
    )


def _placed(panels: Sequence[Panel], top: float) -> Iterator[str]:
    left = GAP
    for panel in panels:
        box = f"0 0 {panel.width:g} {panel.height:g}"
        size = f'width="{panel.width:g}" height="{panel.height:g}"'
        if panel.title:
            title = escape(panel.title)
            yield f'<text class="panel-title" x="{left:g}" y="{top - 9:g}">{title}</text>'
        yield f'<svg x="{left:g}" y="{top:g}" {size} viewBox="{box}">'
        if panel.raster is not None:
            pixelated = ' class="pixelated"' if panel.pixelated else ""
            picture = f"data:image/png;base64,{b64encode(png(panel.raster)).decode()}"
            yield f'<image{pixelated} {size} preserveAspectRatio="none" href="{picture}"/>'
        yield f'<g class="overlay">{panel.overlay}</g></svg>'
        left += panel.width + GAP
