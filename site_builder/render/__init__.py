"""What a passage of the book becomes in each medium: on the screen, on paper, in plain words."""
