"""How long a chapter takes to read."""

from site_builder.document.book import Chapter
from site_builder.render.sections import Describe, sections_of

WORDS_A_MINUTE = 180
"""Of a text with formulae, read with care."""


def reading_minutes(chapter: Chapter, describe: Describe) -> int:
    """Of its text, captions and questions: figures are played with by those who like."""
    words = sum(section.count_words() for section in sections_of(chapter.body, describe))
    return max(1, round(words / WORDS_A_MINUTE))
