"""Models of image formation: arrays in, arrays out, numpy only, no state."""
