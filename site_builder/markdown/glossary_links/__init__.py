"""The terms and symbols that a text uses, and what they mean."""
