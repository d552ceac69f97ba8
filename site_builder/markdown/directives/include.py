"""``{include} parts/file.md``: another Markdown file of ``content/`` in this place.

`includes` puts it there before the chapter is parsed; what gets this far stands where it cannot.
"""

from site_builder.markdown.bodies import no_body
from site_builder.markdown.directive import Argument, Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext


def read_include(call: DirectiveCall, _body: None, context: ParseContext) -> None:
    context.problem(call.line, "{include} is indented; legal: at the margin of its file")


INCLUDE = Directive(
    name="include",
    doc="another Markdown file of `content/`, in this place",
    argument=Argument("parts/file.md", lacks="names no file"),
    body=no_body("the file speaks"),
    read=read_include,
    template="prose",
)
