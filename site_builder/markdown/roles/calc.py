"""``{calc}`degrees(atan(18 / 50)):.1f` ``: a number computed while the book is built."""

from simulations.engine.expressions import ExpressionError
from site_builder.markdown.calculation import number_text
from site_builder.markdown.role import Role

CALC = Role(
    name="calc",
    form="EXPRESSION` or `EXPRESSION:FORMAT",
    doc=(
        "the number that an expression comes to, in Python's format (`:.2f`); in formulae "
        r"`\calc{EXPRESSION:FORMAT}`. A code block `calc`, which is not shown, imports functions "
        "of the models, names values for the expressions below it, and checks what the text claims "
        "by `assert CONDITION`"
    ),
    text=number_text,
    refuses=ExpressionError,
)
