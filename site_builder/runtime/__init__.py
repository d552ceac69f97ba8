"""What the reader's browser runs: Pyodide, numpy and our simulations, fetched and packed."""
