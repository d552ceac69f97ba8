"""A package per widget: its settings, what is computed of them, and how that is drawn."""
