"""Three-dimensional drawings: a view, and wires, faces and arrows drawn back to front."""
