"""The book on paper, as an e-book, as notebooks, and its questions for learning platforms.

An edition is a function to bytes: from `compose.Composed` (chapters, back matter and answers for
paper, and the files they load), or from the document where it is not made of rendered pages.
"""
