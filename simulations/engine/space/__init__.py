"""Space on a flat panel: a view of it, and wires, faces and arrows drawn back to front."""
