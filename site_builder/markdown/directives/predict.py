"""``{predict} id``: a guess before the answer."""

from site_builder.document.passage import passage
from site_builder.document.questions import Prediction
from site_builder.markdown.directive import Numbered
from site_builder.markdown.questions.question import prediction_id, question_directive

PREDICT = question_directive(
    "predict",
    Prediction,
    lambda _call, prompt, _context: passage(prompt),
    doc="a guess, before the answer",
    kind_doc="what is guessed",
    numbered=Numbered("Prediction", prediction_id),
)
