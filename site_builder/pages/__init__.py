"""From the document to HTML and `book.json`."""
