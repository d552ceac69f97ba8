"""What chapters refer to: works, terms and symbols; and the news."""
