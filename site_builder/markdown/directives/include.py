"""``{include} parts/file.md``: another Markdown file of ``content/`` in this place.

`splicing` puts it there before the chapter is parsed; what gets this far stands where it cannot.
"""

from site_builder.markdown.bodies import no_body
from site_builder.markdown.directive import Argument, Directive, Use
from site_builder.markdown.reading import Reading


def read_include(use: Use, _body: None, reading: Reading) -> None:
    reading.problem(use.line, "{include} is indented; legal: at the margin of its file")


INCLUDE = Directive(
    name="include",
    says="another Markdown file of `content/`, in this place",
    argument=Argument("parts/file.md", lacks="names no file"),
    body=no_body("the file speaks"),
    read=read_include,
    template="prose",
)
