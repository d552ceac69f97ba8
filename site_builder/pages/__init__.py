"""From the page model to HTML and `book.json`."""
