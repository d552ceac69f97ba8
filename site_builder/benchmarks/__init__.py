"""Measuring the ladders, the measurements, and the numbers, verdicts and charts made of them."""
