"""``content/book.toml``: what it may say, declared once; read, checked, described from that."""
