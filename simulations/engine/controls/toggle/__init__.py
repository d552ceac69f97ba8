"""A kind of control: on or off."""
