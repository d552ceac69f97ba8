"""Questions: what is asked, its answers by kinds, and what is worked out of them."""
