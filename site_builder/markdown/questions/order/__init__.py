"""A kind of question: things to put in order."""
