"""Simulations of image formation, run by the build and in the reader's browser."""
