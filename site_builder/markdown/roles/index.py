"""``{index}`Tomasi and Kanade <Tomasi, C.>```: words that the index of terms leads to."""

from site_builder.markdown.headings import slug
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Linked, Role


def indexed(words: str, given: str | None, line: int, context: ParseContext) -> Linked:
    """The words with an id, and the entry to list them under."""
    entry = words if given is None else given
    name = context.free_id(f"index-{slug(entry)}", line)
    return Linked({"id": name}, meta={"index": entry})


INDEX = Role(
    name="index",
    form="WORDS` or `WORDS <ENTRY>",
    doc="the words, listed in the index of terms",
    link=indexed,
)
