"""What moves in the German book."""
