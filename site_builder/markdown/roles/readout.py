"""``{readout}`lens-distortion corner k1=-0.2```: a number that a figure shows, never typed.

The words are a scene, one of its readouts, and the controls that differ from their defaults;
``tier=ID`` chooses an accuracy. The text gets what the figure shows at that setting,
with its unit; ``bare`` at the end leaves the unit out. The scene is drawn while the book is
built, once for each setting.
"""

from site_builder.benchmarks.readouts import ReadoutError
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Role

FORM = "SCENE READOUT [CONTROL=VALUE …] [tier=ID] [bare]"


def readout_text(words: str, context: ParseContext) -> str:
    """What stands in the text for ``words``. Raises `ReadoutError`."""
    scene_id, _, rest = words.partition(" ")
    name, *pairs = rest.split() or [""]
    bare = pairs[-1:] == ["bare"]
    settings = dict(pair.split("=", 1) for pair in pairs[: len(pairs) - bare] if "=" in pair)
    if not name or "=" in name or len(settings) + bare < len(pairs):
        raise ReadoutError(f"{{readout}} {words!r}; legal: '{FORM}', each control once")
    shown = context.readouts.text(scene_id, name, settings, bare=bare)
    return context.shared.words.numeral(shown)


READOUT = Role(
    name="readout",
    form=FORM,
    doc="a number that a figure shows at that setting",
    text=readout_text,
    refuses=ReadoutError,
)
