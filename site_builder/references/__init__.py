"""What stands beside the chapters: the works cited, the terms, the symbols, the news."""
