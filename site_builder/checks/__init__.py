"""What is looked for in a book that has been read: before a page is written, or by ``check``."""
