"""Numbers that are looked up or computed, never typed."""
