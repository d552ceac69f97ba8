"""Frames of scenes that are drawn while the book is built."""
