"""A book in further languages: what is translated stands in ``content/LANGUAGE/``."""
