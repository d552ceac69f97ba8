"""The book without a network: the release that the reader's browser caches."""
