"""Runs a figure with definitions that its reader has edited."""
