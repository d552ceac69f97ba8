"""The figure of a chequerboard to print."""
