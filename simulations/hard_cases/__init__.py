"""Tables of hard cases, one file per model, run by the tests and printed in the book."""
