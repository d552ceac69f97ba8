"""What every widget is made of: controls, frames, drawing, the stage pipeline."""
