"""Tables of hard cases, one file per model: executed by the tests, printed in the book."""
