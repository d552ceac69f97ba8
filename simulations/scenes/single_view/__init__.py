"""The scene single-view: a camera and lengths from lines drawn over one picture."""
