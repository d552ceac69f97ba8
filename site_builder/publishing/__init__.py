"""What the world outside the site is told of it: its address, pictures for links, its changes."""
