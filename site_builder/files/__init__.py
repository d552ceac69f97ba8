"""Files of the book and of the engine: found, read as text, packed into archives."""
