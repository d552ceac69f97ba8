"""A package per figure: its settings, computation, drawing and handles."""
