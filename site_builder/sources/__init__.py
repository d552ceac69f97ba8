"""From the author's files to a book, in its own language and in translations."""
