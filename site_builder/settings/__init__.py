"""``content/book.toml``: its keys, declared once; reading and description follow from that."""
