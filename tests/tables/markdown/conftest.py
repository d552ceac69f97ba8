"""Fixtures of the little book."""

from support.little_book import bundled as bundled
from support.little_book import make_book as make_book
