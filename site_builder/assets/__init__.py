"""What pages load: style sheets, scripts, fonts, pictures, and Python for the browser."""
