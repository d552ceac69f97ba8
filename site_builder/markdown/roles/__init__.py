"""Every role that asks for a number, one file each."""
