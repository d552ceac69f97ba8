"""A wipe between two pictures, shared by figures that compare them."""
