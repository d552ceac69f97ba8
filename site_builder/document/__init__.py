"""The book between Markdown and its media: chapters, blocks, passages, targets, questions."""
