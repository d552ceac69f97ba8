"""``{predict} id``: a guess before the answer."""

from site_builder.markdown.directive import Numbered
from site_builder.markdown.questions.question import prediction_id, question_directive
from site_builder.page_model.passage import passage
from site_builder.page_model.questions import Prediction

PREDICT = question_directive(
    "predict",
    Prediction,
    lambda _call, prompt, _context: passage(prompt),
    doc="a guess, before the answer",
    kind_doc="what is guessed",
    numbered=Numbered("Prediction", prediction_id),
)
