"""The templates: where they lie, their functions, and what each has of the book."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache, partial
from pathlib import Path

from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined, pass_context
from jinja2.bccache import Bucket
from jinja2.runtime import Context
from markupsafe import Markup

from site_builder.benchmarks.judgements import milliseconds, quantity
from site_builder.document.book import Book
from site_builder.document.places import Passage
from site_builder.figures.drawn_pictures import with_files
from site_builder.files.folders import SIZE, address_of, bytes_hash, cache_folder, replace_file
from site_builder.markdown.questions.kind import HERE as QUESTION_KINDS
from site_builder.markdown.questions.kinds import kind_of
from site_builder.markdown.text.code import highlighted_lines
from site_builder.pages.back_matter import marked_terms
from site_builder.pages.policy import page_policy
from site_builder.pages.views.ladder import (
    default_error,
    slowest_to_quickest,
    view_chart,
    view_ladder,
)
from site_builder.pages.views.question import kind_view, question_data
from site_builder.pages.views.simulation import CONTROL_KINDS
from site_builder.references.bibliography import full_stop
from site_builder.render.screen import PassageRenderer, named, screen_renderer
from site_builder.settings.model import storage_prefix


@pass_context
def passage_html(context: Context, passage: Passage) -> Markup:
    renderer: PassageRenderer = context["renderer"]
    return renderer(passage)


@pass_context
def spoken_html(context: Context, passage: Passage) -> Markup:
    """Markup of words that name something; paper has formulae without labels."""
    html = passage_html(context, passage)
    return html if context.get("paper") else named(html)


TEMPLATES = Path(__file__).parents[1] / "templates"
FOLDERS = (TEMPLATES, QUESTION_KINDS.parent, CONTROL_KINDS.parent)
"""Where templates lie: those of kinds in the folders of these."""
FILTERS: Mapping[str, Callable[..., object]] = {
    "address": address_of,
    "with_files": with_files,
    "kind": kind_of,
    "kind_view": kind_view,
    "question_data": question_data,
    "view_ladder": view_ladder,
    "view_chart": view_chart,
    "default_error": default_error,
    "slowest_to_quickest": slowest_to_quickest,
    "quantity": quantity,
    "milliseconds": milliseconds,
    "marked_terms": marked_terms,
    "passage": passage_html,
    "spoken": spoken_html,
    "full_stop": full_stop,
    "highlighted": lambda code: highlighted_lines(code, "python"),
}
"""Functions of templates, for what is computed from the document."""


def render_template(template: str, book: Book, **context: object) -> str:
    """A filled template that uses the book, and not the site."""
    return template_environment().get_template(template).render(book_context(book), **context)


def book_context(book: Book) -> dict[str, object]:
    """What every template has of the book and its language; ``t`` is a text of the interface."""
    return {
        "book": book,
        "words": book.words,
        "t": book.words.html,
        "renderer": screen_renderer(book.words),
        "policy": partial(
            page_policy, raw_html=book.settings.trust.raw_html, published=bool(book.address)
        ),
        "storage": storage_prefix(book.settings),
    }


@cache
def template_environment() -> Environment:
    environment = Environment(
        auto_reload=False,
        bytecode_cache=CompiledTemplates(cache_folder() / "compiled"),
        loader=FileSystemLoader(FOLDERS),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters.update(FILTERS)
    return environment


class CompiledTemplates(BytecodeCache):
    """Compiled templates, each in a file behind its hash: to compile them takes longer than to fill
    them. One that is damaged, or cannot be written, is compiled again."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def load_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            data = (self._folder / bucket.key).read_bytes()
            if bytes_hash(data[SIZE:]) == data[:SIZE]:
                bucket.bytecode_from_string(data[SIZE:])

    def dump_bytecode(self, bucket: Bucket) -> None:
        code = bucket.bytecode_to_string()
        with suppress(OSError):
            self._folder.mkdir(exist_ok=True)
            replace_file(self._folder / bucket.key, bytes_hash(code) + code)
