"""Every directive, one file each."""
