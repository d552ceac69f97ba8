"""A package of QTI 2.1: a file for each question, a test with a section for each chapter, and the
manifest that lists them. Of a question that draws numbers, the test selects one variant. IMS
Question and Test Interoperability 2.1, Assessment Test, Section and Item Information Model; IMS
Content Packaging 1.1.4."""

from itertools import groupby

from site_builder.document.book import Book
from site_builder.editions.questions.asked import asked_in, written
from site_builder.editions.questions.words import qti_text
from site_builder.files.archive import archive_of
from site_builder.pages.environment import render_template


def make_qti(book: Book) -> bytes:
    """The archive. The same book is the same bytes."""
    asked = list(asked_in(book))
    chapters = [
        (chapter, [(name, list(some)) for name, some in groupby(group, lambda a: a.drawn_from)])
        for chapter, group in groupby(asked, lambda a: a.chapter)
    ]
    files = {
        "imsmanifest.xml": render_template("editions/qti-manifest.xml", book, items=asked),
        "test.xml": render_template("editions/qti-test.xml", book, chapters=chapters),
        **{
            f"items/{item.id}.xml": written(book, item, "qti", qti_text(item.page))
            for item in asked
        },
    }
    return archive_of({name: content.encode() for name, content in files.items()})
