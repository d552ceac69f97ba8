"""Results of pure functions, stored under hashes of what they depend on."""
