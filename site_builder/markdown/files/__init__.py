"""A chapter's file before it is Markdown: its head, the files that it takes in or shows."""
