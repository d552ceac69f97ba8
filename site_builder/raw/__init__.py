"""Raw files of cameras: what decodes them in the browser."""
