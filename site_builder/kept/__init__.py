"""Results that are kept between builds, under a hash of all that they depend on."""
