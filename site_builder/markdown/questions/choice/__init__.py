"""A kind of question: answers to choose from."""
