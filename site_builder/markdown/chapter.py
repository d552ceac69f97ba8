"""One Markdown file to one `Chapter`: parse, annotate, split into blocks."""

from site_builder.book import Chapter, Need, chapter_id
from site_builder.markdown.blocks import read_blocks
from site_builder.markdown.figures import place_figures
from site_builder.markdown.front_matter import read_front_matter
from site_builder.markdown.inline import annotate, inline_html
from site_builder.markdown.reading import PAGE_IDS, Reading


def read_chapter(text: str, number: int, reading: Reading) -> Chapter:
    """The chapter in ``text``; mistakes are reported and reading goes on."""
    tokens = reading.parser.parse(text, reading.env)
    for line, message in reading.env.pop("problems", ()):
        reading.problem(line, message)
    matter = read_front_matter(tokens, reading)
    place_figures(tokens, reading)
    annotate(tokens, reading)
    body = read_blocks(tokens, reading)
    before = tuple(
        Need(inline_html(entry.text, entry.line, reading), entry.chapter, entry.line)
        for entry in matter.before
    )
    after = tuple(inline_html(entry.text, entry.line, reading) for entry in matter.after)
    return Chapter(
        number=number,
        id=chapter_id(reading.path),
        path=reading.path,
        title=matter.title,
        summary=matter.summary,
        body=body,
        headings=tuple(reading.headings),
        anchors=frozenset(reading.ids) - set(PAGE_IDS),
        links=tuple(reading.links),
        before=before,
        after=after,
    )
