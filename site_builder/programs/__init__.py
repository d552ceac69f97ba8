"""Programs that the build runs: Node with packages from npm, and Chromium."""
