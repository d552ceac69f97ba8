"""``{quiz}`` asks, ``{predict}`` asks for a guess, and ``{answer}`` is hidden until it was made."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.document.blocks import Block
from site_builder.document.passage import Passage, passage
from site_builder.document.questions import Prediction, Quiz, Reveal
from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, DirectiveCall, Numbered
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.questions.question import prediction_id, question_directive


def _prompt(call: DirectiveCall, prompt: Sequence[Token], context: ParseContext) -> Passage:
    """The question as phrasing content, all that a paragraph may hold: one line below another."""
    shown: list[list[Token]] = []
    for token in prompt:
        if token.type == "inline":
            shown.append(list(token.children or ()))
        elif token.type in ("math_block", "math_block_label"):
            shown.append([Token("math_inline", "math", 0, content=token.content, meta=token.meta)])
        elif token.type not in ("paragraph_open", "paragraph_close"):
            context.problem(
                call.line,
                f"the question of quiz {call.argument!r} holds more than text and formulae; "
                "legal: put it above the quiz",
            )
            break
    first, *others = shown or [[]]
    lines = [*first]
    for line in others:
        lines += [Token("hardbreak", "br", 0), *line]
    return passage([Token("inline", "", 0, children=lines)])


QUIZ = question_directive(
    "quiz",
    Quiz,
    _prompt,
    doc="a question with explained answers",
    kind_doc="how it is answered",
    numbered=Numbered("Question", lambda call: f"quiz-{call.argument}"),
    draws=True,
)


PREDICT = question_directive(
    "predict",
    Prediction,
    lambda _call, prompt, _context: passage(prompt),
    doc="a guess, before the answer",
    kind_doc="what is guessed",
    numbered=Numbered("Prediction", prediction_id),
)


def read_reveal(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Reveal:
    name = context.free_id(f"answer-{call.argument}", call.line)
    return Reveal(call.argument, name, context.path, call.line)


ANSWER = Directive(
    name="answer",
    doc="what is hidden until the prediction of that id is answered",
    argument=Argument("id", lacks="names no prediction"),
    body=BLOCKS,
    read=read_reveal,
    template="answer",
)
