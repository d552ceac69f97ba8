"""What running text is made of: formulae, code, typography."""
