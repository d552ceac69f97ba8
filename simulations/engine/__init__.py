"""The parts of every figure: controls, frames, drawing, the stage pipeline."""
