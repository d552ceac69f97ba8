"""The authors' own code while the book is built: within limits, and once for each setting."""
