"""What a chapter is made of, between Markdown and HTML. Frozen all the way down."""
